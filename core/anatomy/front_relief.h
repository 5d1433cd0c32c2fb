#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>

#include "core/geometry/front_grid.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"

namespace semblante {

/// How far forward a model is seen at each place, straight from the front: on a fine grid, and on coarser ones of which
/// each has half the knots of the one before along a side. Lengths are the model's.
class FrontRelief {
 public:
  struct Level {
    FrontGrid grid;
    std::vector<double> z;  ///< by knot; NaN where nothing is seen

    /// At the nearest knot; NaN where nothing is seen.
    [[nodiscard]] double at(double x, double y) const;
  };

  /// `triangles` are of file vertices; `turn` is what turns the model upright. Empty if they are too many on top of
  /// each other to be drawn in a second.
  static std::optional<FrontRelief> draw(const Surface& surface, std::span<const Triangle> triangles,
                                         const glm::dmat3& turn = glm::dmat3(1.0));

  [[nodiscard]] const Level& finest() const { return levels_.front(); }
  /// The coarsest level whose knots are at most `step` apart; the finest if none is as fine.
  [[nodiscard]] const Level& with_step(double step) const;

  [[nodiscard]] double width() const { return finest().grid.step * finest().grid.columns; }
  [[nodiscard]] double height() const { return finest().grid.step * finest().grid.rows; }

 private:
  std::vector<Level> levels_;  ///< from fine to coarse
};

}  // namespace semblante

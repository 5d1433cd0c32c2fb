#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/anatomy/front_column.h"
#include "core/anatomy/seen_lid_edge.h"
#include "core/geometry/similarity.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// A place of the skin that is seen from the front, with the surface vertex nearest to it.
struct SeenSpot {
  glm::dvec3 place{0.0};  ///< in the frame of the face
  SurfaceVertexId vertex;
};

/// A face as it is seen straight from the front, in columns of one x. Places are in an upright frame of unit ES0 with
/// its origin between the eyes.
class FaceFront {
 public:
  /// The face reaches this far to either side.
  static constexpr double half_width = 1.5;
  /// The x of its middle: edges that lie along 0 are cut by no column there.
  static constexpr double middle = 1e-4;

  /// `frame` maps positions of `surface` to the frame; `triangles` are of file vertices. Keeps references to all but
  /// the triangles.
  FaceFront(const Surface& surface, std::span<const Part> parts, std::span<const Triangle> triangles,
            const Similarity& frame);

  [[nodiscard]] FrontColumn column(double x) const;
  /// The greatest span between two heights at which an eyeball is seen (seen_lid_edge.h).
  [[nodiscard]] std::optional<SeenEye> eye(double x, double low, double high) const;
  /// The skin that `column` shows at the height of `place`; empty if it shows an eyeball there, or nothing.
  [[nodiscard]] std::optional<SeenSpot> spot(const FrontColumn& column, const glm::dvec3& place) const;

 private:
  struct Extent {
    double low, high;  ///< of x
    Triangle triangle;
  };
  [[nodiscard]] std::vector<Triangle> cut_at(double x) const;

  const Surface& surface_;
  std::span<const Part> parts_;
  const Similarity& frame_;
  std::vector<Extent> triangles_;  ///< of the face
};

}  // namespace semblante

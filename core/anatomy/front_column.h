#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/geometry/similarity.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// What is seen straight from the front in the plane of one x: the nearest skin or eyeball at each height. Other parts
/// (hair, lashes, glasses) hide nothing.
class FrontColumn {
 public:
  /// `frame` maps positions of `surface` to an upright face, of which `x` is a coordinate. `triangles` are of file
  /// vertices.
  FrontColumn(const Surface& surface, std::span<const Part> parts, std::span<const Triangle> triangles,
              const Similarity& frame, double x);

  /// Where the plane cuts a triangle.
  struct Piece {
    std::array<glm::dvec3, 2> ends;                         ///< in the frame
    std::array<std::array<SurfaceVertexId, 2>, 2> edges{};  ///< of each end: the edge that it lies on, lower id first
    bool is_skin = false;
  };
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }

  struct Seen {
    bool is_skin = false;
    double z = 0.0;
    std::size_t piece = 0;  ///< in pieces()
  };
  [[nodiscard]] std::optional<Seen> at(double y) const;

 private:
  std::vector<Piece> pieces_;
};

}  // namespace semblante

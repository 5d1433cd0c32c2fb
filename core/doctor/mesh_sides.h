#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/surface.h"
#include "core/types/model.h"

namespace semblante {

/// A side of a triangle on the stitched surface.
struct MeshSide {
  std::uint32_t low, high;  ///< surface vertices, low < high
  std::uint32_t across;     ///< the triangle's third corner
  std::uint32_t triangle;   ///< index into Model::triangles
  bool rising;              ///< the winding of the triangle leads from low to high
};

/// The sides of all triangles on the surface, sorted by shared edges.
struct MeshSides {
  std::vector<MeshSide> sides;                 ///< of whole triangles, each triangle once; by (low, high)
  std::vector<std::uint32_t> degenerate;       ///< triangles without area, in order: collapsed to an edge or a point
  std::vector<std::uint32_t> repeated;         ///< triangles whose three vertices an earlier one has, in order
  std::vector<std::uint32_t> edge_offsets{0};  ///< #E + 1, into sides

  [[nodiscard]] std::size_t edge_count() const { return edge_offsets.size() - 1; }
  [[nodiscard]] std::span<const MeshSide> sides_of(std::size_t edge) const {
    return std::span(sides).subspan(edge_offsets[edge], edge_offsets[edge + 1] - edge_offsets[edge]);
  }
};

/// `surface` must be build_surface(model). O(#T log #T) time, 60 bytes per triangle.
MeshSides sort_sides(const Model& model, const Surface& surface);

}  // namespace semblante

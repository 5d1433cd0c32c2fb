#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/types/model.h"
#include "core/types/strong_id.h"

namespace semblante {

/// The stitched surface of a model: file vertices split by a seam are merged to one surface vertex,
/// and the mesh edges between surface vertices form a graph. The mesh need not be manifold.
///
/// A part is a connected component of that graph. Parts are ordered by their lowest file vertex; all unused vertices
/// form one last part without triangles.
struct Surface {
  /// A step along a mesh edge.
  struct Step {
    double length;       ///< Euclidean, computed in double from the float32 positions
    SurfaceVertexId to;  ///
  };

  std::vector<SurfaceVertexId> surface_of;  ///< #V file vertices -> surface vertex
  std::vector<VertexId> file_vertex_of;     ///< #S, the lowest file vertex of each; rises
  std::vector<glm::dvec3> positions;        ///< #S, the float32 positions, widened

  std::vector<std::uint32_t> step_offsets;  ///< #S + 1
  std::vector<Step> steps;                  ///< 2 #E, each edge once from either end; no loops, no doubles

  std::vector<PartId> part_of;                ///< #S
  std::vector<std::uint32_t> part_offsets;    ///< #P + 1
  std::vector<SurfaceVertexId> part_members;  ///< #S, grouped by part, rising within one

  [[nodiscard]] std::size_t vertex_count() const { return positions.size(); }
  [[nodiscard]] std::size_t part_count() const { return part_offsets.size() - 1; }
  [[nodiscard]] std::span<const Step> steps_from(SurfaceVertexId vertex) const {
    const std::uint32_t first = step_offsets[vertex.value()];
    return std::span(steps).subspan(first, step_offsets[vertex.value() + 1] - first);
  }
  [[nodiscard]] std::span<const SurfaceVertexId> members_of(PartId part) const {
    const std::uint32_t first = part_offsets[part.value()];
    return std::span(part_members).subspan(first, part_offsets[part.value() + 1] - first);
  }
};

/// Builds the surface of `model`. Triangles with a repeated vertex are ignored; duplicate triangles count once. Indices
/// of the model must be in range (import checks them).
Surface build_surface(const Model& model);

}  // namespace semblante

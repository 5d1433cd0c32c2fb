#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/triangle_place.h"

namespace semblante {

/// The corner (0, 1, 2) of triangle abc that a place with these shares means: one within a tenth of the shorter of its
/// two edges. Empty: none, the place is between vertices.
std::optional<std::size_t> meant_corner(const glm::dvec3& shares, const glm::dvec3& a, const glm::dvec3& b,
                                        const glm::dvec3& c);

/// The shares of a place between vertices, moved to an edge if the share of the opposite corner is at most a
/// twentieth: a vertex there would make a needle, and on a border the border is meant.
glm::dvec3 moved_to_edge(const glm::dvec3& shares);

/// A vertex that was inserted into a mesh: whatever a mesh has per vertex is there the sum of the corners', each times
/// its share. The corners may be vertices that were inserted before. On an edge one share is zero.
struct InsertedVertex {
  std::array<std::uint32_t, 3> corners{};
  glm::dvec3 shares{0.0};
};

struct Insertion {
  std::vector<std::uint32_t> vertex_of_place;  ///< by place: a new vertex, or an old one if that is meant
  std::vector<InsertedVertex> vertices;        ///< in the order of their numbers, which follow those of the model
};

/// Inserts a vertex at each place, in order: a place inside a triangle splits it into three, a place on an edge splits
/// all triangles at that edge, on both sides of a seam. Several places may lie on one triangle. Places that mean a
/// vertex, given or inserted before, take that vertex (meant_corner).
///
/// Positions, UVs, normals and morph targets are interpolated. The shape, all vertices with their numbers, and the
/// order of triangles and primitives are kept; new triangles follow those that they were parts of. A model without
/// normals gets smooth ones first: computed afterwards, those at the new vertices would be flat. `surface` is
/// build_surface of the model before; afterwards it must be built again.
Insertion insert_vertices(Model& model, const Surface& surface, std::span<const TrianglePlace> places);

/// Adds the positions of the inserted vertices to another shape of the same mesh.
void add_inserted(std::vector<glm::vec3>& shape, std::span<const InsertedVertex> vertices);

}  // namespace semblante

#include "core/doctor/mesh_sides.h"

#include <algorithm>
#include <array>
#include <tuple>

#include <glm/geometric.hpp>

#include "core/geometry/triangle_shape.h"

namespace semblante {
namespace {

/// Minimum height relative to the length of a triangle; the normal of a flatter triangle is only rounding error.
constexpr double least_height = 1e-6;

using Corners = std::array<std::uint32_t, 3>;

bool has_area(const Surface& surface, const Corners& c) {
  if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) return false;
  const glm::dvec3& a = surface.positions[c[0]];
  const glm::dvec3& b = surface.positions[c[1]];
  const glm::dvec3& d = surface.positions[c[2]];
  const double longest = std::max({glm::distance(a, b), glm::distance(b, d), glm::distance(d, a)});
  return glm::length(area_vector(a, b, d)) > least_height * longest * longest;
}

}  // namespace

MeshSides sort_sides(const Model& model, const Surface& surface) {
  MeshSides mesh;
  mesh.sides.reserve(model.triangles.size() * 3);
  for (std::uint32_t t = 0; t < model.triangles.size(); ++t) {
    const Triangle& corners = model.triangles[t];
    const Corners c = {surface.surface_of[corners[0]].value(), surface.surface_of[corners[1]].value(),
                       surface.surface_of[corners[2]].value()};
    if (!has_area(surface, c)) {
      mesh.degenerate.push_back(t);
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = c[k];
      const std::uint32_t to = c[(k + 1) % 3];
      mesh.sides.push_back({std::min(from, to), std::max(from, to), c[(k + 2) % 3], t, from < to});
    }
  }
  std::sort(mesh.sides.begin(), mesh.sides.end(), [](const MeshSide& a, const MeshSide& b) {
    return std::tie(a.low, a.high, a.across, a.triangle) < std::tie(b.low, b.high, b.across, b.triangle);
  });
  // A duplicate triangle has all its sides twice: counted at each side, reported at its lowest vertex.
  const auto again = [&](const MeshSide& a, const MeshSide& b) {
    if (std::tie(a.low, a.high, a.across) != std::tie(b.low, b.high, b.across)) return false;
    if (b.high < b.across) mesh.repeated.push_back(b.triangle);
    return true;
  };
  mesh.sides.erase(std::unique(mesh.sides.begin(), mesh.sides.end(), again), mesh.sides.end());
  std::sort(mesh.repeated.begin(), mesh.repeated.end());

  for (std::uint32_t s = 1; s <= mesh.sides.size(); ++s) {
    if (s < mesh.sides.size() && mesh.sides[s].low == mesh.sides[s - 1].low &&
        mesh.sides[s].high == mesh.sides[s - 1].high)
      continue;
    mesh.edge_offsets.push_back(s);
  }
  return mesh;
}

}  // namespace semblante

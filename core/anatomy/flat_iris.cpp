#include "core/anatomy/flat_iris.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "core/geometry/triangle_shape.h"

namespace semblante {
namespace {

constexpr double flat = 0.9945;            ///< cosine of six degrees: files may have only three decimals
constexpr double frontal = 0.8;            ///< cosine of the angle between the eye's axis and a facet at its front
constexpr double regular = 0.2;            ///< of the mean radius, by which a corner may be nearer or farther
constexpr std::size_t fewest_corners = 5;  ///< of a polygon that is no mere triangle or quad
constexpr std::size_t most_corners = 256;  ///< of a polygon, and facets at the marked vertex

struct Facet {
  std::array<SurfaceVertexId, 3> corners;
  glm::dvec3 normal;

  [[nodiscard]] bool has(SurfaceVertexId v) const {
    return std::find(corners.begin(), corners.end(), v) != corners.end();
  }
};

/// The facets of a part that face in about the direction of the eye.
std::vector<Facet> facets_in_front(const Model& model, const Surface& surface, PartId part, const glm::dvec3& axis) {
  std::vector<Facet> front;
  for (const Triangle& triangle : model.triangles) {
    Facet facet;
    for (std::size_t i = 0; i < 3; ++i) facet.corners[i] = surface.surface_of[triangle[i]];
    if (surface.part_of[facet.corners[0].value()] != part) continue;
    const auto at = [&](std::size_t i) -> const glm::dvec3& { return surface.positions[facet.corners[i].value()]; };
    const glm::dvec3 normal = area_vector(at(0), at(1), at(2));
    const double size = glm::length(normal);
    if (!(size > 0.0) || glm::dot(normal, axis) < frontal * size) continue;
    facet.normal = normal / size;
    front.push_back(facet);
  }
  return front;
}

/// The corners of the flat polygon around a facet; empty if they are too many.
std::vector<SurfaceVertexId> polygon_around(const Facet& seed, std::span<const Facet> front) {
  std::vector<SurfaceVertexId> corners(seed.corners.begin(), seed.corners.end());
  const auto is_known = [&](SurfaceVertexId v) {
    return std::find(corners.begin(), corners.end(), v) != corners.end();
  };
  for (bool grown = true; grown;) {
    grown = false;
    for (const Facet& facet : front) {
      if (glm::dot(facet.normal, seed.normal) < flat) continue;
      if (std::count_if(facet.corners.begin(), facet.corners.end(), is_known) != 2) continue;
      const auto added = std::find_if_not(facet.corners.begin(), facet.corners.end(), is_known);
      corners.push_back(*added);
      if (corners.size() > most_corners) return {};
      grown = true;
    }
  }
  return corners;
}

/// The centre of a regular polygon; nullopt for a vertex in the middle, or what is not a regular ring.
std::optional<glm::dvec3> centre_of(const Surface& surface, std::span<const SurfaceVertexId> corners) {
  if (corners.size() < fewest_corners) return std::nullopt;
  const auto count = static_cast<double>(corners.size());
  glm::dvec3 middle(0.0);
  for (const SurfaceVertexId v : corners) middle += surface.positions[v.value()];
  middle /= count;
  const auto radius = [&](SurfaceVertexId v) { return glm::distance(surface.positions[v.value()], middle); };
  double mean = 0.0;
  for (const SurfaceVertexId v : corners) mean += radius(v);
  mean /= count;
  const bool is_regular = std::all_of(corners.begin(), corners.end(),
                                      [&](SurfaceVertexId v) { return std::abs(radius(v) - mean) <= regular * mean; });
  return is_regular ? std::optional(middle) : std::nullopt;
}

}  // namespace

std::optional<glm::dvec3> middle_of_flat_iris(const Model& model, const Surface& surface, SurfaceVertexId marked,
                                              const glm::dvec3& axis) {
  const std::vector<Facet> front = facets_in_front(model, surface, surface.part_of[marked.value()], axis);
  const auto around = std::count_if(front.begin(), front.end(), [&](const Facet& facet) { return facet.has(marked); });
  if (static_cast<std::size_t>(around) > most_corners) return std::nullopt;
  for (const Facet& facet : front) {
    if (!facet.has(marked)) continue;
    if (const auto middle = centre_of(surface, polygon_around(facet, front))) return middle;
  }
  return std::nullopt;
}

}  // namespace semblante

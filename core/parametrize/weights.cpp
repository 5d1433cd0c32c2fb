#include "core/parametrize/weights.h"

#include <cmath>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>

namespace semblante {
namespace {

/// The data of a neighbour j of point i, the same for every P.
struct Neighbor {
  glm::dvec3 direction;  ///< (j - i) / |j - i|
  double distance;       ///< d_ij along the surface
};

std::vector<std::vector<Neighbor>> neighbors_of_points(const PointDistances& distances,
                                                       const std::vector<SlotSet>& regions) {
  const std::vector<SlotSet> sets = region_neighbors(regions, distances.points.size());
  std::vector<std::vector<Neighbor>> neighbors(sets.size());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    sets[i].for_each([&](std::size_t j) {
      const glm::dvec3 offset = distances.points[j].position - distances.points[i].position;
      const double length = glm::length(offset);
      // Two points at one place have no direction between them: no angle, so never valid.
      if (length > 0.0) neighbors[i].push_back({offset / length, distances.between_points(i, j)});
    });
  }
  return neighbors;
}

/// d of Eq. 1 to 3: the reach of point i's influence towards P. nullopt without a valid neighbour.
std::optional<double> reach_towards(const glm::dvec3& p, const glm::dvec3& i, std::span<const Neighbor> neighbors) {
  const glm::dvec3 offset = p - i;
  const double length = glm::length(offset);
  if (!(length > 0.0)) return std::nullopt;
  double weighted = 0.0;
  double cosines = 0.0;
  std::size_t valid = 0;
  for (const Neighbor& j : neighbors) {
    const double cosine = glm::dot(offset, j.direction) / length;
    if (!(cosine > least_cosine)) continue;
    weighted += j.distance * cosine;
    cosines += cosine;
    ++valid;
  }
  if (valid == 0) return std::nullopt;
  // Eq. 2: one neighbour. weighted = d_i1 cos, so d_i1 / cos = weighted / cos^2; Eq. 3 with n = 1 would lose the
  // cosine.
  if (valid == 1) return weighted / (cosines * cosines);
  return weighted / cosines;  // Eq. 1, Eq. 3
}

}  // namespace

WeightTable<double> part_weights(const Surface& surface, const PointDistances& distances,
                                 const std::vector<SlotSet>& regions) {
  const std::vector<std::vector<Neighbor>> neighbors = neighbors_of_points(distances, regions);
  WeightTable<double> table;
  std::vector<double> row;
  for (std::size_t m = 0; m < distances.members.size(); ++m) {
    const SurfaceVertexId vertex = distances.members[m];
    const glm::dvec3& p = surface.positions[vertex.value()];
    const std::span<const double> to_points = distances.of_member(m, row);
    regions[m].for_each([&](std::size_t i) {
      const SurfacePoint& point = distances.points[i];
      const std::optional<double> reach = reach_towards(p, point.position, neighbors[i]);
      // A vertex at the same place as the point (an edge of length zero) has no angle to any neighbour; Eq. 4 gives it
      // 1 for every d.
      if (to_points[i] == 0.0) {
        table.push(point.id, 1.0);
      } else if (reach && to_points[i] < *reach) {
        table.push(point.id, std::sin(std::numbers::pi / 2.0 * (1.0 - to_points[i] / *reach)));  // Eq. 4
      }
    });
    for (std::size_t i = 0; regions[m].empty() && i < distances.points.size(); ++i) {
      if (distances.points[i].vertex == vertex) table.push(distances.points[i].id, 1.0);
    }
    table.end_row();
  }
  return table;
}

}  // namespace semblante

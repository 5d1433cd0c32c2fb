#include "core/parametrize/weights.h"

#include <cmath>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>

#include "core/parametrize/direction_pair.h"

namespace semblante {
namespace {

/// Two neighbours j of a point i, the same for every P. The last may be one alone.
struct Neighbors {
  DirectionPair direction;  ///< (j - i) / |j - i|
  NumberPair distance{};    ///< d_ij along the surface
};

std::vector<std::vector<Neighbors>> neighbors_of_points(const PointDistances& distances,
                                                        const std::vector<SlotSet>& regions) {
  const std::vector<SlotSet> sets = region_neighbors(regions, distances.points.size());
  std::vector<std::vector<Neighbors>> neighbors(sets.size());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    std::size_t count = 0;
    sets[i].for_each([&](std::size_t j) {
      const glm::dvec3 offset = distances.points[j].position - distances.points[i].position;
      const double length = glm::length(offset);
      // Two points at one place have no direction between them: no angle, so never valid.
      if (!(length > 0.0)) return;
      const std::size_t lane = count++ % 2;
      if (lane == 0) neighbors[i].emplace_back();
      neighbors[i].back().direction.set(lane, offset / length);
      neighbors[i].back().distance[lane] = distances.between_points(i, j);
    });
  }
  return neighbors;
}

/// d of Eq. 1 to 3: the reach of point i's influence towards P. nullopt without a valid neighbour.
std::optional<double> reach_towards(const glm::dvec3& p, const glm::dvec3& i, std::span<const Neighbors> neighbors) {
  const glm::dvec3 offset = p - i;
  const double length = glm::length(offset);
  if (!(length > 0.0)) return std::nullopt;
  double weighted = 0.0;
  double cosines = 0.0;
  decltype(NumberPair{} > NumberPair{}) counts{};
  for (const Neighbors& j : neighbors) {
    const NumberPair cosine = j.direction.dot(offset) / length;
    // Without a branch: half of the neighbours are valid, so that it would be unpredictable.
    const auto is_valid = cosine > least_cosine;
    const NumberPair counted = is_valid ? cosine : NumberPair{};
    const NumberPair product = j.distance * counted;
    counts -= is_valid;
    for (std::size_t k = 0; k < 2; ++k) {
      weighted += product[k];
      cosines += counted[k];
    }
  }
  const auto valid = counts[0] + counts[1];
  if (valid == 0) return std::nullopt;
  // Eq. 2: one neighbour. weighted = d_i1 cos, so d_i1 / cos = weighted / cos^2; Eq. 3 with n = 1 would lose the
  // cosine.
  if (valid == 1) return weighted / (cosines * cosines);
  return weighted / cosines;  // Eq. 1, Eq. 3
}

}  // namespace

WeightTable<double> part_weights(const Surface& surface, const PointDistances& distances,
                                 const std::vector<SlotSet>& regions) {
  const std::vector<std::vector<Neighbors>> neighbors = neighbors_of_points(distances, regions);
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

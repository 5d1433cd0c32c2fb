#include "core/parametrize/influence_regions.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace semblante {
namespace {

/// From one point to another: g - f and its length, the same for every vertex.
struct Offset {
  glm::dvec3 vector;
  double length;
};

std::vector<Offset> offsets_between(const std::vector<SurfacePoint>& points) {
  std::vector<Offset> offsets;
  offsets.reserve(points.size() * points.size());
  for (const SurfacePoint& f : points) {
    for (const SurfacePoint& g : points) {
      const glm::dvec3 vector = g.position - f.position;
      offsets.push_back({vector, glm::length(vector)});
    }
  }
  return offsets;
}

/// Section 4 for one vertex P. `left` is scratch: the set A, as slots in rising order.
class RegionOfVertex {
 public:
  explicit RegionOfVertex(const std::vector<SurfacePoint>& points)
      : points_(points), offsets_(offsets_between(points)), left_(points.size()) {}

  SlotSet operator()(const glm::dvec3& p, std::span<const double> distances) {
    // 1. A = all points reachable from P; B = empty.
    std::size_t count = 0;
    for (std::size_t slot = 0; slot < points_.size(); ++slot) {
      if (distances[slot] != std::numeric_limits<double>::infinity()) left_[count++] = slot;
    }
    SlotSet chosen;
    while (count > 0) {  // 4. until A is empty
      // 2. Move the nearest point from A to B; slots rise with the ids, so the first of a tie has the lowest id.
      double least = distances[left_[0]];
      for (std::size_t k = 1; k < count; ++k) least = std::min(least, distances[left_[k]]);
      std::size_t pick = 0;
      while (distances[left_[pick]] > least * (1.0 + distance_tie)) ++pick;
      const std::size_t f = left_[pick];
      chosen.insert(f);

      // 3. Remove from A each g beyond the plane through f normal to f - P.
      const glm::dvec3 normal = points_[f].position - p;
      const double limit = least_cosine * glm::length(normal);
      const Offset* const from_f = offsets_.data() + f * points_.size();
      std::size_t kept = 0;
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t g = left_[k];
        const bool beyond = glm::dot(from_f[g].vector, normal) > limit * from_f[g].length;
        left_[kept] = g;
        kept += static_cast<std::size_t>(!beyond && g != f);
      }
      count = kept;
    }
    return chosen;
  }

 private:
  const std::vector<SurfacePoint>& points_;
  std::vector<Offset> offsets_;  ///< #F x #F
  std::vector<std::size_t> left_;
};

}  // namespace

std::vector<SlotSet> influence_regions(const Surface& surface, const PointDistances& distances) {
  std::vector<bool> is_point(surface.vertex_count(), false);
  for (const SurfacePoint& point : distances.points) is_point[point.vertex.value()] = true;

  RegionOfVertex region_of(distances.points);
  std::vector<SlotSet> regions(distances.members.size());
  std::vector<double> row;
  for (std::size_t m = 0; m < regions.size(); ++m) {
    const std::uint32_t vertex = distances.members[m].value();
    if (!is_point[vertex]) regions[m] = region_of(surface.positions[vertex], distances.of_member(m, row));
  }
  return regions;
}

std::vector<SlotSet> region_neighbors(const std::vector<SlotSet>& regions, std::size_t point_count) {
  std::vector<SlotSet> together(point_count);
  for (const SlotSet& region : regions) {
    region.for_each([&](std::size_t i) { together[i].unite(region); });
  }
  std::vector<SlotSet> neighbors(point_count);
  for (std::size_t i = 0; i < point_count; ++i) {
    together[i].for_each([&](std::size_t j) {
      if (j != i) neighbors[i].insert(j);
    });
  }
  return neighbors;
}

}  // namespace semblante

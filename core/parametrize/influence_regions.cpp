#include "core/parametrize/influence_regions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "core/parametrize/direction_pair.h"

namespace semblante {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Section 4 for one vertex P. Every round looks at all points, two at a time: that takes less time than to keep a list
/// of those that are left.
class RegionOfVertex {
 public:
  explicit RegionOfVertex(const std::vector<SurfacePoint>& points)
      : points_(points), pairs_((points.size() + 1) / 2), directions_(points.size() * pairs_), left_(pairs_) {
    for (std::size_t f = 0; f < points.size(); ++f) {
      for (std::size_t g = 0; g < points.size(); ++g) {
        const glm::dvec3 offset = points[g].position - points[f].position;
        const double length = glm::length(offset);
        // A point at the same place is in no direction: it lies beyond no plane.
        if (length > 0.0) directions_[f * pairs_ + g / 2].set(g % 2, offset / length);
      }
    }
  }

  SlotSet operator()(const glm::dvec3& p, std::span<const double> distances) {
    // 1. A = all points reachable from P; B = empty.
    NumberPair nearest = {infinity, infinity};
    for (std::size_t k = 0; k < pairs_; ++k) {
      left_[k] = NumberPair{distances[2 * k], 2 * k + 1 < distances.size() ? distances[2 * k + 1] : infinity};
      nearest = left_[k] < nearest ? left_[k] : nearest;
    }
    SlotSet chosen;
    while (std::min(nearest[0], nearest[1]) < infinity) {  // 4. until A is empty
      // 2. Move the nearest point from A to B; slots rise with the ids, so the first of a tie has the lowest id.
      const double tie = std::min(nearest[0], nearest[1]) * (1.0 + distance_tie);
      std::size_t pair = 0;
      while (left_[pair][0] > tie && left_[pair][1] > tie) ++pair;
      const std::size_t f = 2 * pair + (left_[pair][0] > tie ? 1 : 0);
      chosen.insert(f);
      left_[pair][f % 2] = infinity;

      // 3. Remove from A each g beyond the plane through f normal to f - P.
      const glm::dvec3 normal = points_[f].position - p;
      const double limit = least_cosine * glm::length(normal);
      const DirectionPair* const from_f = directions_.data() + f * pairs_;
      nearest = NumberPair{infinity, infinity};
      for (std::size_t k = 0; k < pairs_; ++k) {
        left_[k] = from_f[k].dot(normal) > limit ? NumberPair{infinity, infinity} : left_[k];
        nearest = left_[k] < nearest ? left_[k] : nearest;
      }
    }
    return chosen;
  }

 private:
  const std::vector<SurfacePoint>& points_;
  std::size_t pairs_;                      ///< of points, the last of an odd number with none
  std::vector<DirectionPair> directions_;  ///< #F x #pairs: (g - f) / |g - f|, the same for every vertex
  std::vector<NumberPair> left_;           ///< the set A: distances by slot, infinity for points that are not in it
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

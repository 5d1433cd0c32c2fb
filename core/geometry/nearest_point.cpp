#include "core/geometry/nearest_point.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace semblante {
namespace {
/// Ranges with no more nodes are not split.
constexpr std::size_t leaf_points = 16;
}  // namespace

NearestPoint::NearestPoint(std::span<const glm::dvec3> points) {
  assert(!points.empty());
  nodes_.reserve(points.size());
  for (const glm::dvec3& p : points) nodes_.push_back({p, static_cast<std::uint32_t>(nodes_.size())});
  std::size_t count = 1;
  for (std::size_t longest = nodes_.size(); longest > leaf_points; longest /= 2) count = 2 * count + 1;
  ranges_.resize(count);
  ranges_[0] = range_of(0, nodes_.size());
}

double NearestPoint::Range::squared_distance(const glm::dvec3& to) const {
  const glm::dvec3 outside = to - glm::clamp(to, low, high);
  return glm::dot(outside, outside);
}

NearestPoint::Range NearestPoint::range_of(std::size_t first, std::size_t last) const {
  Range range{nodes_[first].position, nodes_[first].position};
  for (std::size_t i = first + 1; i < last; ++i) {
    range.low = glm::min(range.low, nodes_[i].position);
    range.high = glm::max(range.high, nodes_[i].position);
  }
  return range;
}

void NearestPoint::split(std::size_t range, std::size_t first, std::size_t last) {
  const glm::dvec3 size = ranges_[range].high - ranges_[range].low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&](std::size_t i) { return nodes_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last),
                   [axis](const Node& a, const Node& b) { return a.position[axis] < b.position[axis]; });
  ranges_[2 * range + 1] = range_of(first, middle);
  ranges_[2 * range + 2] = range_of(middle + 1, last);
  ranges_[range].is_split = true;
}

template <class Look>
void NearestPoint::go_through(std::size_t range, std::size_t first, std::size_t last, const glm::dvec3& to,
                              const double& reach, const Look& look) {
  const auto look_at = [&](const Node& node) {
    const glm::dvec3 away = node.position - to;
    look(node.index, glm::dot(away, away));
  };
  if (last - first <= leaf_points) {
    for (std::size_t i = first; i < last; ++i) look_at(nodes_[i]);
    return;
  }
  if (!ranges_[range].is_split) split(range, first, last);
  const std::size_t middle = first + (last - first) / 2;
  look_at(nodes_[middle]);
  const std::size_t front = 2 * range + 1;
  const std::size_t behind = 2 * range + 2;
  const double to_front = ranges_[front].squared_distance(to);
  const double to_behind = ranges_[behind].squared_distance(to);
  if (to_front < to_behind) {
    if (!(to_front > reach)) go_through(front, first, middle, to, reach, look);
    if (!(to_behind > reach)) go_through(behind, middle + 1, last, to, reach, look);
  } else {
    if (!(to_behind > reach)) go_through(behind, middle + 1, last, to, reach, look);
    if (!(to_front > reach)) go_through(front, first, middle, to, reach, look);
  }
}

template <class Look>
void NearestPoint::go_through_all(const glm::dvec3& to, const double& reach, const Look& look) {
  if (!(ranges_[0].squared_distance(to) > reach)) go_through(0, 0, nodes_.size(), to, reach, look);
}

NearestPoint::Hit NearestPoint::nearest(const glm::dvec3& to) {
  std::uint32_t nearest = std::numeric_limits<std::uint32_t>::max();
  double least = std::numeric_limits<double>::infinity();
  // Equal distances are examined: the lowest index is returned.
  go_through_all(to, least, [&](std::uint32_t index, double squared) {
    if (squared > least || (squared == least && index > nearest)) return;
    least = squared;
    nearest = index;
  });
  return {nearest, std::sqrt(least)};
}

std::vector<std::uint32_t> NearestPoint::nearest_with_ties(const glm::dvec3& to, double within) {
  constexpr double tie = (1.0 + 1e-6) * (1.0 + 1e-6);
  double least = within * within;
  double reach = least * tie;  // of what may be as near as the nearest, which is less than `within`
  bool is_found = false;
  std::vector<std::pair<std::uint32_t, double>> near;  // all that were nearest, or as near, when they were examined
  go_through_all(to, reach, [&](std::uint32_t index, double squared) {
    if (squared > reach) return;
    near.emplace_back(index, squared);
    if (squared >= least) return;
    is_found = true;
    least = squared;
    reach = least * tie;
  });
  std::vector<std::uint32_t> indices;
  if (!is_found) return indices;
  for (const auto& [index, squared] : near) {
    if (squared <= reach) indices.push_back(index);
  }
  std::sort(indices.begin(), indices.end());
  return indices;
}

bool NearestPoint::has_within(const glm::dvec3& to, double distance) {
  double reach = distance * distance;
  bool is_found = false;
  go_through_all(to, reach, [&](std::uint32_t, double squared) {
    if (!(squared < reach)) return;
    is_found = true;
    reach = -1.0;  // no more ranges
  });
  return is_found;
}

}  // namespace semblante

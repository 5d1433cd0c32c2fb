#include "core/geometry/nearest_point.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

namespace semblante {
namespace {
/// Ranges with no more nodes are not split.
constexpr std::size_t leaf_size = 16;
}  // namespace

NearestPoint::NearestPoint(std::span<const glm::dvec3> points) {
  assert(!points.empty());
  nodes_.reserve(points.size());
  for (const glm::dvec3& p : points) nodes_.push_back({p, static_cast<std::uint32_t>(nodes_.size())});
  build(0, nodes_.size(), 0);
}

void NearestPoint::build(std::size_t first, std::size_t last, int axis) {
  if (last - first <= leaf_size) return;
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&](std::size_t i) { return nodes_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last),
                   [axis](const Node& a, const Node& b) { return a.position[axis] < b.position[axis]; });
  build(first, middle, (axis + 1) % 3);
  build(middle + 1, last, (axis + 1) % 3);
}

template <class Look>
void NearestPoint::go_through(std::size_t first, std::size_t last, int axis, const glm::dvec3& to,
                              const glm::dvec3& outside, const double& reach, const Look& look) const {
  if (glm::dot(outside, outside) > reach) return;
  const auto look_at = [&](const Node& node) {
    const glm::dvec3 away = node.position - to;
    look(node.index, glm::dot(away, away));
  };
  if (last - first <= leaf_size) {
    for (std::size_t i = first; i < last; ++i) look_at(nodes_[i]);
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  look_at(nodes_[middle]);
  const double beyond = to[axis] - nodes_[middle].position[axis];
  glm::dvec3 farther = outside;
  farther[axis] = beyond;
  const int next = (axis + 1) % 3;
  if (beyond < 0.0) {
    go_through(first, middle, next, to, outside, reach, look);
    go_through(middle + 1, last, next, to, farther, reach, look);
  } else {
    go_through(middle + 1, last, next, to, outside, reach, look);
    go_through(first, middle, next, to, farther, reach, look);
  }
}

NearestPoint::Hit NearestPoint::nearest(const glm::dvec3& to) const {
  std::uint32_t nearest = std::numeric_limits<std::uint32_t>::max();
  double least = std::numeric_limits<double>::infinity();
  // Equal distances are examined: the lowest index is returned.
  go_through(0, nodes_.size(), 0, to, glm::dvec3(0.0), least, [&](std::uint32_t index, double squared) {
    if (squared > least || (squared == least && index > nearest)) return;
    least = squared;
    nearest = index;
  });
  return {nearest, std::sqrt(least)};
}

std::vector<std::uint32_t> NearestPoint::nearest_with_ties(const glm::dvec3& to, double within) const {
  constexpr double tie = (1.0 + 1e-6) * (1.0 + 1e-6);
  double least = within * within;
  double reach = least * tie;  // of what may be as near as the nearest, which is less than `within`
  bool is_found = false;
  std::vector<std::pair<std::uint32_t, double>> near;  // all that were nearest, or as near, when they were examined
  go_through(0, nodes_.size(), 0, to, glm::dvec3(0.0), reach, [&](std::uint32_t index, double squared) {
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

bool NearestPoint::has_within(const glm::dvec3& to, double distance) const {
  double reach = distance * distance;
  bool is_found = false;
  go_through(0, nodes_.size(), 0, to, glm::dvec3(0.0), reach, [&](std::uint32_t, double squared) {
    if (!(squared < reach)) return;
    is_found = true;
    reach = -1.0;  // no more ranges
  });
  return is_found;
}

}  // namespace semblante

#include "core/geometry/nearest_point.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

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

void NearestPoint::search(std::size_t first, std::size_t last, int axis, const glm::dvec3& to, std::uint32_t& index,
                          double& squared) const {
  const auto compare = [&](const Node& node) {
    const glm::dvec3 away = node.position - to;
    const double here = glm::dot(away, away);
    if (here < squared || (here == squared && node.index < index)) {
      squared = here;
      index = node.index;
    }
  };
  if (last - first <= leaf_size) {
    for (std::size_t i = first; i < last; ++i) compare(nodes_[i]);
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  const Node& node = nodes_[middle];
  compare(node);
  const double beyond = to[axis] - node.position[axis];
  const int next = (axis + 1) % 3;
  const bool low_first = beyond < 0.0;
  if (low_first) {
    search(first, middle, next, to, index, squared);
  } else {
    search(middle + 1, last, next, to, index, squared);
  }
  if (beyond * beyond > squared) return;  // equal distances are examined: the lowest index is returned
  if (low_first) {
    search(middle + 1, last, next, to, index, squared);
  } else {
    search(first, middle, next, to, index, squared);
  }
}

NearestPoint::Hit NearestPoint::nearest(const glm::dvec3& to) const {
  std::uint32_t index = std::numeric_limits<std::uint32_t>::max();
  double squared = std::numeric_limits<double>::infinity();
  search(0, nodes_.size(), 0, to, index, squared);
  return {index, std::sqrt(squared)};
}

double NearestPoint::square_within(const glm::dvec3& to, double bound) const {
  // No index is below 0, so a point as far as the bound does not count as nearer.
  std::uint32_t index = 0;
  search(0, nodes_.size(), 0, to, index, bound);
  return bound;
}

void NearestPoint::collect(std::size_t first, std::size_t last, int axis, const glm::dvec3& to, double squared,
                           std::vector<std::uint32_t>& indices) const {
  const auto add_if_near = [&](const Node& node) {
    const glm::dvec3 away = node.position - to;
    if (glm::dot(away, away) <= squared) indices.push_back(node.index);
  };
  if (last - first <= leaf_size) {
    for (std::size_t i = first; i < last; ++i) add_if_near(nodes_[i]);
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  const Node& node = nodes_[middle];
  add_if_near(node);
  const double beyond = to[axis] - node.position[axis];
  const int next = (axis + 1) % 3;
  if (beyond <= 0.0 || beyond * beyond <= squared) collect(first, middle, next, to, squared, indices);
  if (beyond >= 0.0 || beyond * beyond <= squared) collect(middle + 1, last, next, to, squared, indices);
}

std::vector<std::uint32_t> NearestPoint::nearest_with_ties(const glm::dvec3& to, double within) const {
  constexpr double tie = 1e-6;
  std::vector<std::uint32_t> indices;
  const double bound = within * within;
  const double squared = square_within(to, bound);
  if (!(squared < bound)) return indices;
  collect(0, nodes_.size(), 0, to, squared * (1.0 + tie) * (1.0 + tie), indices);
  std::sort(indices.begin(), indices.end());
  return indices;
}

bool NearestPoint::has_within(const glm::dvec3& to, double distance) const {
  const double bound = distance * distance;
  return square_within(to, bound) < bound;
}

}  // namespace semblante

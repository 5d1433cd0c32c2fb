#include "core/geometry/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/geometry/nearest_weights.h"

namespace semblante {
namespace {

constexpr std::uint32_t leaf_triangles = 4;

}  // namespace

TriangleTree::TriangleTree(std::span<const glm::vec3> positions, std::span<const Triangle> triangles)
    : positions_(positions), triangles_(triangles), order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(triangles.size());
  if (!triangles.empty()) build(0, static_cast<std::uint32_t>(triangles.size()));
}

void TriangleTree::enclose(Node& node, std::uint32_t first, std::uint32_t last) const {
  node.low = node.high = positions_[triangles_[order_[first]][0]];
  for (std::uint32_t i = first; i < last; ++i) {
    for (const std::uint32_t v : triangles_[order_[i]]) {
      node.low = glm::min(node.low, positions_[v]);
      node.high = glm::max(node.high, positions_[v]);
    }
  }
}

std::uint32_t TriangleTree::build(std::uint32_t first, std::uint32_t last) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  if (last - first <= leaf_triangles) {
    Node& leaf = nodes_[at];
    leaf.first = first;
    leaf.count = last - first;
    enclose(leaf, first, last);
    return at;
  }
  const auto center = [this](std::uint32_t t) {
    const Triangle& v = triangles_[t];
    return positions_[v[0]] + positions_[v[1]] + positions_[v[2]];
  };
  glm::vec3 low = center(order_[first]);
  glm::vec3 high = low;
  for (std::uint32_t i = first; i < last; ++i) {
    low = glm::min(low, center(order_[i]));
    high = glm::max(high, center(order_[i]));
  }
  const glm::vec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  // Split by count, so that the depth is bounded for any positions.
  const std::uint32_t middle = first + (last - first) / 2;
  const auto place = [this](std::uint32_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(place(first), place(middle), place(last), [&](std::uint32_t a, std::uint32_t b) {
    const float ca = center(a)[axis];
    const float cb = center(b)[axis];
    return ca < cb || (ca == cb && a < b);
  });
  build(first, middle);
  const std::uint32_t right = build(middle, last);
  Node& node = nodes_[at];
  node.right = right;
  node.low = glm::min(nodes_[at + 1].low, nodes_[right].low);
  node.high = glm::max(nodes_[at + 1].high, nodes_[right].high);
  return at;
}

void TriangleTree::move_to(std::span<const glm::vec3> positions) {
  positions_ = positions;
  // Children come after their parents.
  for (std::size_t at = nodes_.size(); at-- > 0;) {
    Node& node = nodes_[at];
    if (node.count > 0) {
      enclose(node, node.first, node.first + node.count);
      continue;
    }
    node.low = glm::min(nodes_[at + 1].low, nodes_[node.right].low);
    node.high = glm::max(nodes_[at + 1].high, nodes_[node.right].high);
  }
}

void TriangleTree::consider(std::uint32_t triangle, const glm::dvec3& to, Hit& hit, double& squared) const {
  const Triangle& t = triangles_[triangle];
  const glm::dvec3 a(positions_[t[0]]);
  const glm::dvec3 b(positions_[t[1]]);
  const glm::dvec3 c(positions_[t[2]]);
  const glm::dvec3 weights = nearest_weights(to, a, b, c);
  const glm::dvec3 away = to - (weights.x * a + weights.y * b + weights.z * c);
  const double here = glm::dot(away, away);
  if (here < squared || (here == squared && triangle < hit.triangle)) {
    squared = here;
    hit.triangle = triangle;
    hit.weights = weights;
  }
}

}  // namespace semblante

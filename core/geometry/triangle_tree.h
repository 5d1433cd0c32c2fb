#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "core/types/model.h"

namespace semblante {

/// Nearest point on a set of triangles: a bounding box tree. Triangles may be degenerate. O(log #T) per query for
/// well separated triangles, at most O(#T).
class TriangleTree {
 public:
  /// Keeps references to both arguments.
  TriangleTree(std::span<const glm::vec3> positions, std::span<const Triangle> triangles);

  /// Updates the tree for new vertex positions in O(#T). Correct for any positions, fast if neighbours stay close to
  /// each other.
  void move_to(std::span<const glm::vec3> positions);

  struct Hit {
    std::uint32_t triangle = 0;
    glm::dvec3 weights{0.0};  ///< barycentric, of the triangle's corners
    double distance = std::numeric_limits<double>::infinity();
  };

  /// The nearest point to `to` on triangles with `accept(triangle)`; `distance` is infinite if there is none. Of
  /// equally near triangles the lowest is returned. `guess`: a triangle that may be near, to speed up the search.
  template <class Accept>
  [[nodiscard]] Hit nearest(const glm::dvec3& to, const Accept& accept, std::uint32_t guess = Model::no_index) const {
    Hit hit;
    double squared = std::numeric_limits<double>::infinity();
    if (guess != Model::no_index) consider(guess, to, hit, squared);
    if (!nodes_.empty()) search(0, to, accept, hit, squared);
    hit.distance = std::sqrt(squared);
    return hit;
  }

 private:
  /// The children of an inner node are the next node and `right`; a leaf has triangles order_[first..first+count).
  struct Node {
    glm::vec3 low, high;
    std::uint32_t right = 0, first = 0, count = 0;
  };

  std::uint32_t build(std::uint32_t first, std::uint32_t last);
  void enclose(Node& node, std::uint32_t first, std::uint32_t last) const;
  void consider(std::uint32_t triangle, const glm::dvec3& to, Hit& hit, double& squared) const;

  [[nodiscard]] static double squared_distance(const Node& node, const glm::dvec3& to) {
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double outside = std::max({double(node.low[axis]) - to[axis], to[axis] - double(node.high[axis]), 0.0});
      sum += outside * outside;
    }
    return sum;
  }

  template <class Accept>
  void search(std::uint32_t at, const glm::dvec3& to, const Accept& accept, Hit& hit, double& squared) const {
    const Node& node = nodes_[at];
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        if (accept(order_[i])) consider(order_[i], to, hit, squared);
      }
      return;
    }
    std::uint32_t near = at + 1;
    std::uint32_t far = node.right;
    double to_near = squared_distance(nodes_[near], to);
    double to_far = squared_distance(nodes_[far], to);
    if (to_far < to_near) {
      std::swap(near, far);
      std::swap(to_near, to_far);
    }
    if (to_near <= squared) search(near, to, accept, hit, squared);
    if (to_far <= squared) search(far, to, accept, hit, squared);
  }

  std::span<const glm::vec3> positions_;
  std::span<const Triangle> triangles_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace semblante

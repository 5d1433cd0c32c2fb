#include "clients/native/render/smooth_normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include <glm/geometric.hpp>

namespace semblante::render {

SmoothNormals::SmoothNormals(std::span<const glm::vec3> positions, std::span<const Triangle> triangles,
                             std::span<const std::uint8_t> group_of_triangle)
    : triangles_(triangles.begin(), triangles.end()), joined_(positions.size()) {
  std::vector<std::uint8_t> group(positions.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t v : triangles[t]) {
      group[v] = group_of_triangle[t];
    }
  }
  const auto key = [&](std::uint32_t v) {
    const glm::vec3& p = positions[v];
    return std::make_tuple(p.x, p.y, p.z, group[v]);
  };
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same_as_last = i > 0 && key(order[i]) == key(order[i - 1]);
    joined_[order[i]] = same_as_last ? joined_[order[i - 1]] : order[i];
  }
}

std::vector<glm::vec3> SmoothNormals::compute(std::span<const glm::vec3> positions) const {
  std::vector<glm::vec3> normals(joined_.size(), glm::vec3(0.0F));
  for (const Triangle& triangle : triangles_) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const glm::vec3& p = positions[triangle[corner]];
      const glm::vec3 a = positions[triangle[(corner + 1) % 3]] - p;
      const glm::vec3 b = positions[triangle[(corner + 2) % 3]] - p;
      const glm::vec3 across = glm::cross(a, b);
      const float twice_area = glm::length(across);
      if (twice_area > 0.0F) {
        // By angle, so that the way a polygon was cut into triangles does not show.
        const float angle = std::atan2(twice_area, glm::dot(a, b));
        normals[joined_[triangle[corner]]] += across * (angle / twice_area);
      }
    }
  }
  for (glm::vec3& normal : normals) {
    const float length = glm::length(normal);
    normal = length > 0.0F ? normal / length : glm::vec3(0, 0, 1);
  }
  for (std::size_t v = 0; v < normals.size(); ++v) {
    normals[v] = normals[joined_[v]];
  }
  return normals;
}

}  // namespace semblante::render

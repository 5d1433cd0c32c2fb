#include "clients/native/render/smooth_normals.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/types/place.h"

namespace semblante::render {

namespace {

static_assert(sizeof(Triangle) == 3 * sizeof(std::uint32_t) && sizeof(glm::vec3) == 3 * sizeof(float));

}  // namespace

SmoothNormals::SmoothNormals(std::span<const glm::vec3> positions, std::vector<glm::vec3> own,
                             std::span<const Triangle> triangles, std::span<const std::uint8_t> group_of_triangle)
    : triangles_(triangles.begin(), triangles.end()),
      joined_(positions.size()),
      own_(std::move(own)),
      at_rest_(positions.size()) {
  std::vector<std::uint8_t> group(positions.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t v : triangles[t]) {
      group[v] = group_of_triangle[t];
    }
  }
  const auto key = [&](std::uint32_t v) { return std::pair(place_key(positions[v]), group[v]); };
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same_as_last = i > 0 && key(order[i]) == key(order[i - 1]);
    joined_[order[i]] = same_as_last ? joined_[order[i - 1]] : order[i];
  }
  if (positions.empty()) return;
  const semblante_triangles mesh = table();
  semblante_rest_normals(&mesh, &positions.front().x, &own_.front().x, &at_rest_.front().x);
}

semblante_triangles SmoothNormals::table() const {
  return {static_cast<std::uint32_t>(joined_.size()), static_cast<std::uint32_t>(triangles_.size()),
          triangles_.empty() ? nullptr : triangles_.front().data(), joined_.data()};
}

std::vector<glm::vec3> SmoothNormals::compute(std::span<const glm::vec3> positions) const {
  std::vector<glm::vec3> normals(joined_.size());
  if (normals.empty()) {
    return normals;
  }
  const semblante_triangles mesh = table();
  semblante_normals(&mesh, &positions.front().x, &normals.front().x);
  semblante_turn_normals(mesh.vertex_count, &own_.front().x, &at_rest_.front().x, &normals.front().x);
  return normals;
}

}  // namespace semblante::render

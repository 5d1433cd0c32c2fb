#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/types/model.h"

namespace semblante::render {

/// Normals for shading that do not show where a file splits its vertices. Built once on the neutral head, since a
/// deformed one may bring two vertices to one place that are no seam (closed lips).
class SmoothNormals {
 public:
  /// `group_of_triangle`: vertices at one place are joined within a group only, so that lashes leave a lid's shading
  /// alone. One value a triangle.
  SmoothNormals(std::span<const glm::vec3> positions, std::span<const Triangle> triangles,
                std::span<const std::uint8_t> group_of_triangle);

  /// Unit normals of `positions` (deformed, same numbering), one a vertex; +Z where no triangle has an area.
  [[nodiscard]] std::vector<glm::vec3> compute(std::span<const glm::vec3> positions) const;

 private:
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> joined_;  ///< #V: the lowest vertex at the same place in the same group
};

}  // namespace semblante::render

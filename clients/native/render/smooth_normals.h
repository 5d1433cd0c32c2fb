#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/types/model.h"

namespace semblante::render {

/// Normals for shading without visible seams where a file splits its vertices. Built once on the neutral head, because
/// in a deformed one two vertices without a seam may have the same position (closed lips).
class SmoothNormals {
 public:
  /// `group_of_triangle`: one value per triangle. Vertices at one place are joined only within a group, so that lashes
  /// do not affect the shading of a lid.
  SmoothNormals(std::span<const glm::vec3> positions, std::span<const Triangle> triangles,
                std::span<const std::uint8_t> group_of_triangle);

  /// Unit normals of `positions` (deformed, same numbering), one per vertex; +Z for a vertex without a triangle with an
  /// area.
  [[nodiscard]] std::vector<glm::vec3> compute(std::span<const glm::vec3> positions) const;

 private:
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> joined_;  ///< #V: the lowest vertex at the same place in the same group
};

}  // namespace semblante::render

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/kernel/semblante_normals.h"
#include "core/types/model.h"

namespace semblante::render {

/// Normals for shading without visible seams where a file splits its vertices: those of the file, turned as the surface
/// turns. Built once on the neutral head, because in a deformed one two vertices without a seam may have the same
/// position (closed lips).
class SmoothNormals {
 public:
  SmoothNormals() = default;  ///< of nothing

  /// `own`: #V, the normals of the file, of any length; zero where it has none. `group_of_triangle`: one value per
  /// triangle. Vertices at one place are joined only within a group, so that lashes do not affect the shading of a lid.
  /// Joined vertices may have different normals in the file, and keep them: hard edges stay hard.
  SmoothNormals(std::span<const glm::vec3> positions, std::vector<glm::vec3> own, std::span<const Triangle> triangles,
                std::span<const std::uint8_t> group_of_triangle);

  /// Unit normals of `positions` (deformed, same numbering), one per vertex; +Z for a vertex without a triangle with an
  /// area and without a normal of its own.
  [[nodiscard]] std::vector<glm::vec3> compute(std::span<const glm::vec3> positions) const;

 private:
  [[nodiscard]] semblante_triangles table() const;

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> joined_;  ///< #V: the lowest vertex at the same place in the same group
  std::vector<glm::vec3> own_;         ///< #V, unit
  std::vector<glm::vec3> at_rest_;     ///< #V, from the triangles of the neutral head
};

}  // namespace semblante::render

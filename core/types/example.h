#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace semblante {

/// A morph target of a model: the displacement of each moving file vertex at weight 1. core/extract makes displacement
/// sets from it.
struct Example {
  std::string name;                      ///< as in the file, printable
  std::vector<std::uint32_t> vertices;   ///< #E moving file vertices, ascending
  std::vector<glm::vec3> displacements;  ///< #E, in the axes and unit of Model::positions

  /// Displacement of a file vertex: zero for one that is not listed. O(log #E).
  [[nodiscard]] glm::vec3 at(std::uint32_t vertex) const {
    const auto found = std::lower_bound(vertices.begin(), vertices.end(), vertex);
    if (found == vertices.end() || *found != vertex) return glm::vec3(0.0F);
    return displacements[static_cast<std::size_t>(found - vertices.begin())];
  }

  /// Adds the displacements, times `weight`, to positions of the model's file vertices.
  void add_to(std::vector<glm::vec3>& positions, float weight = 1.0F) const {
    for (std::size_t i = 0; i < vertices.size(); ++i) positions[vertices[i]] += weight * displacements[i];
  }
};

}  // namespace semblante

#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace semblante {

/// A shape of a model beside its neutral one (a glTF morph target): the displacement of each file vertex at full
/// strength. Contains only vertices that move. core/extract makes displacement sets
/// from it.
struct Example {
  std::string name;                      ///< as the file calls it, printable
  std::vector<std::uint32_t> vertices;   ///< #E file vertices that move, rising
  std::vector<glm::vec3> displacements;  ///< #E, in the frame and unit of Model::positions

  /// Displacement of a file vertex: zero for one that is not listed. O(log #E).
  [[nodiscard]] glm::vec3 at(std::uint32_t vertex) const {
    const auto found = std::lower_bound(vertices.begin(), vertices.end(), vertex);
    if (found == vertices.end() || *found != vertex) return glm::vec3(0.0F);
    return displacements[static_cast<std::size_t>(found - vertices.begin())];
  }
};

}  // namespace semblante

#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

namespace semblante {

/// A place on a model's triangle: the sum of its corners, each times its share. The shares are not negative and sum to
/// one; on an edge one of them is zero.
struct TrianglePlace {
  std::uint32_t triangle = 0;  ///< index into Model::triangles
  glm::dvec3 shares{0.0};
};

}  // namespace semblante

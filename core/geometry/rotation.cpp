#include "core/geometry/rotation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace semblante {

glm::dmat3 rotation_between(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 axis = glm::cross(from, to);
  return glm::mat3_cast(glm::normalize(glm::dquat(1.0 + glm::dot(from, to), axis.x, axis.y, axis.z)));
}

double degrees_of(const glm::dmat3& rotation) {
  const double cosine = 0.5 * (rotation[0][0] + rotation[1][1] + rotation[2][2] - 1.0);
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

}  // namespace semblante

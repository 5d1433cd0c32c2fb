#include "clients/gateways/vmc/turn.h"

#include <algorithm>
#include <cmath>

#include <glm/mat3x3.hpp>

namespace semblante::vmc {

glm::dquat to_rotation(const Turn& turn) {
  return glm::angleAxis(turn.yaw, glm::dvec3(0, 1, 0)) * glm::angleAxis(turn.pitch, glm::dvec3(1, 0, 0)) *
         glm::angleAxis(turn.roll, glm::dvec3(0, 0, 1));
}

Turn to_turn(const glm::dquat& rotation) {
  // m[column][row]. The face's z axis determines yaw and pitch, the remaining rotation of x and y the roll.
  const glm::dmat3 m = glm::mat3_cast(rotation);
  return {std::atan2(m[2][0], m[2][2]), std::asin(std::clamp(-m[2][1], -1.0, 1.0)), std::atan2(m[0][1], m[1][1])};
}

glm::dquat mirror_x(const glm::dquat& rotation) { return {rotation.w, rotation.x, -rotation.y, -rotation.z}; }

}  // namespace semblante::vmc

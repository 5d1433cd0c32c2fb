#pragma once

#include <glm/gtc/quaternion.hpp>

namespace semblante::vmc {

/// The rotation of a head or an eye, radians, by the right-hand rule about the axes of MPEG-4 (+X to the face's left,
/// +Y up, +Z out of the face), as in FAPs 48 to 50 and 23 to 26: yaw to the face's left, pitch down, roll towards its
/// right shoulder.
struct Turn {
  double yaw = 0.0;
  double pitch = 0.0;
  double roll = 0.0;
};

/// Roll, then pitch, then yaw: the kernel's order.
glm::dquat to_rotation(const Turn& turn);
/// The inverse; pitch within a quarter turn. `rotation` must be a unit quaternion.
Turn to_turn(const glm::dquat& rotation);

/// Unity's axes are left-handed, +X to the right of an avatar that looks along +Z: those of MPEG-4 with x mirrored. A
/// rotation keeps its x component; those of y and z are negated. Its own inverse.
glm::dquat mirror_x(const glm::dquat& rotation);

}  // namespace semblante::vmc

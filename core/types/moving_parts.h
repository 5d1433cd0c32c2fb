#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

namespace semblante {

/// The rigid motion of a vertex after Eq. 7 and before the head's rotation, by its part. Values from `tongue_least` on
/// encode the vertex's share of the tongue's roll.
enum class RigidMotion : std::uint8_t {
  none,
  left_eye,
  right_eye,
  left_iris,   ///< rotates with the eye, and moves outwards when the pupil grows
  right_iris,  ///< likewise
  left_lids,   ///< rolls on the eyeball with its weights of 3.1 and 3.3 (0: it is only kept before the ball)
  right_lids,  ///< likewise of 3.2 and 3.4
  tongue_least = 128,
  tongue = 255,  ///< the whole roll
};

/// False for the unused byte values in between.
constexpr bool is_rigid_motion(std::uint8_t value) {
  return value <= static_cast<std::uint8_t>(RigidMotion::right_lids) ||
         value >= static_cast<std::uint8_t>(RigidMotion::tongue_least);
}

/// The motion for a share of the tongue's roll, 0..1, rounded to 128ths; none below half of a 128th.
inline RigidMotion tongue_motion(double share) {
  const auto steps = std::lround(share * 128.0);
  return steps < 1 ? RigidMotion::none : static_cast<RigidMotion>(127 + std::min(steps, 128L));
}

constexpr double tongue_share(RigidMotion motion) {
  const int value = static_cast<int>(motion);
  return value < 128 ? 0.0 : (value - 127) / 128.0;
}

constexpr bool is_eye(RigidMotion motion) {
  return motion >= RigidMotion::left_eye && motion <= RigidMotion::right_iris;
}
constexpr bool is_left_eye(RigidMotion motion) {
  return motion == RigidMotion::left_eye || motion == RigidMotion::left_iris;
}

/// Radius of the pupil by that of the iris on the neutral face: where eyes are measured and where they are drawn.
inline constexpr float pupil_of_iris = 1.0F / 3.0F;

/// The iris of one eye on the neutral face, in model units.
struct Iris {
  glm::vec3 axis{0.0F, 0.0F, 1.0F};  ///< unit vector from the eye's pivot through the middle of the pupil
  float pupil_radius = 0.0F;
  float iris_radius = 0.0F;  ///< more than pupil_radius
  float bend = 0.0F;         ///< 1 / length: at distance r from the axis the surface is bend * r * r farther along it
};

/// The lids of one eye on the neutral face, which slide round the line through the eye's pivot along x. Lengths in
/// model units, angles in radians.
struct Lids {
  static constexpr std::size_t ball_places = 17;  ///< at which the ball is sampled, from the pole to the equator

  glm::vec3 gaze{0.0F, 0.0F, 1.0F};  ///< unit vector from the eye's pivot through the pupil
  float slit = 0.0F;                 ///< angle about the axis by which the lids close
  float opening = 0.0F;              ///< displacement of 3.1 (3.2) downwards that closes the eye; positive
  /// Upper, lower: share of the eye's pitch that the open lid follows. ICT-FaceKit's shapes of looking down and up give
  /// 0.65 and 0.35, 0.15 and 0.15 for a gaze of 30 degrees.
  std::array<float, 2> gaze_share{0.6F, 0.15F};
  /// Distance of the eyeball's surface from the pivot, at equal steps of sqrt(1 - cosine of the angle to `gaze`) from 0
  /// to 1. All 0: the head has no eyeball that lids could pierce.
  std::array<float, ball_places> ball{};
  /// A vertex rises from the ball by this share of its way: lids of few vertices are flat between them.
  float lift = 0.0F;
};

/// The tongue on the neutral face, in model units.
struct Tongue {
  glm::vec3 origin{0.0F};            ///< a point of the middle line, at half of the tongue's thickness
  glm::vec3 left{1.0F, 0.0F, 0.0F};  ///< unit vector across the tongue, to the face's left
  glm::vec3 up{0.0F, 1.0F, 0.0F};    ///< unit vector perpendicular to `left` and to the tongue's length
  float half_width = 0.0F;           ///< from the middle line to a border
  float roll_limit = 0.0F;           ///< radians: the largest roll at which the tongue does not intersect itself
};

}  // namespace semblante

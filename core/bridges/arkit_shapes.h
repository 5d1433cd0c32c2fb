#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/bridges/generated/arkit_tables.h"
#include "core/kernel/semblante_kernel.h"

namespace semblante::arkit {

/// Index of a shape by its name, at compile time.
consteval std::size_t shape(std::string_view name) {
  for (std::size_t i = 0; i < generated::arkit_shapes.size(); ++i) {
    if (generated::arkit_shapes[i].name == name) return i;
  }
  std::abort();  // no constant expression: another name does not compile
}

inline constexpr std::size_t jaw_open = shape("jawOpen");
inline constexpr std::size_t mouth_close = shape("mouthClose");
inline constexpr std::size_t mouth_funnel = shape("mouthFunnel");
inline constexpr std::size_t mouth_pucker = shape("mouthPucker");
inline constexpr std::size_t tongue_out = shape("tongueOut");

/// The visemes of FAP 1 used for motion without a low-level FAP.
inline constexpr std::uint8_t viseme_a = 10;
inline constexpr std::uint8_t viseme_u = 14;

/// The FAPs and shapes of one eye and its lids.
struct Eye {
  std::size_t blink, look_down, look_in, look_out, look_up, squint, wide;
  std::size_t upper_lid, lower_lid, yaw, pitch;  ///< FAPs
  double outwards;                               ///< sign of the yaw FAP when the eye looks away from the nose
};
inline constexpr Eye eyes[2] = {
    {shape("eyeBlinkLeft"), shape("eyeLookDownLeft"), shape("eyeLookInLeft"), shape("eyeLookOutLeft"),
     shape("eyeLookUpLeft"), shape("eyeSquintLeft"), shape("eyeWideLeft"), 19, 21, 23, 25, 1.0},
    {shape("eyeBlinkRight"), shape("eyeLookDownRight"), shape("eyeLookInRight"), shape("eyeLookOutRight"),
     shape("eyeLookUpRight"), shape("eyeSquintRight"), shape("eyeWideRight"), 20, 22, 24, 26, -1.0},
};

/// Sum of FAPs 19 and 21 (20 and 22) for closed lids: IRISD, the distance between the lids of a neutral face.
inline constexpr double lids_shut = 1024.0;
/// The motion of the lower lid when the lids close from rest.
inline constexpr double lower_lid_shut = (1.0 - generated::arkit_upper_lid_share) * lids_shut;
/// The rotation of an eye at a look coefficient of 1, FAP units.
inline constexpr double full_turn = generated::arkit_eye_full_turn_degrees * 3.14159265358979323846 / 180.0 * 1e5;

/// The change of a FAP by shape `index` at coefficient 1, FAP units.
constexpr double amount(std::size_t index, std::size_t fap) {
  const generated::ArkitShape& shape = generated::arkit_shapes[index];
  for (std::size_t i = shape.first; i < shape.first + shape.count; ++i) {
    if (generated::arkit_entries[i].fap == fap) return generated::arkit_entries[i].value;
  }
  return 0.0;
}

}  // namespace semblante::arkit

#pragma once

#include <array>
#include <string_view>

namespace semblante {

/// How long a cue comes and goes, ms.
struct Ramps {
  double attack, release;
};

struct UsualRamps {
  std::string_view target;  ///< as a performance document names it
  Ramps ramps;
};

/// Of a cue that says neither, in the order of CueTarget. A test holds protocol/SPEC.md and the TypeScript reader to
/// it.
inline constexpr auto usual_ramps = std::to_array<UsualRamps>({
    {"fap", {100.0, 100.0}},
    {"viseme", {70.0, 70.0}},
    {"expression", {300.0, 500.0}},
    {"look_at", {80.0, 80.0}},
    {"blink", {80.0, 160.0}},
    {"head", {400.0, 400.0}},
});
/// The head's part of a look takes at least as long.
inline constexpr Ramps head_ramps = usual_ramps.back().ramps;
/// Duration of a blink that says none, ms.
inline constexpr double blink_ms = usual_ramps[4].ramps.attack + usual_ramps[4].ramps.release;

/// How far performances shut the lids: lids of a neutral face are one iris apart, 1024 units, of which the upper (FAPs
/// 19 and 20) and the lower (21 and 22) take these.
inline constexpr double upper_lid_units = 940.0;
inline constexpr double lower_lid_units = 84.0;

/// How far performances turn an eye, sideways and up or down.
inline constexpr double largest_eye_yaw_degrees = 45.0;
inline constexpr double largest_eye_pitch_degrees = 35.0;

}  // namespace semblante

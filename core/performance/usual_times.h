#pragma once

#include <array>
#include <string_view>

namespace semblante {

/// Times in which a cue reaches its full strength and ends again, ms.
struct Ramps {
  double attack, release;
};

struct UsualRamps {
  std::string_view target;  ///< as a performance document names it
  Ramps ramps;
};

/// Defaults of a cue without ramps of its own, in the order of CueTarget. A test compares them with protocol/SPEC.md
/// and the TypeScript reader.
inline constexpr auto usual_ramps = std::to_array<UsualRamps>({
    {"fap", {100.0, 100.0}},
    {"viseme", {70.0, 70.0}},
    {"expression", {300.0, 500.0}},
    {"look_at", {80.0, 80.0}},
    {"blink", {80.0, 160.0}},
    {"head", {400.0, 400.0}},
});
/// Minimum ramps of the head's part of a look.
inline constexpr Ramps head_ramps = usual_ramps.back().ramps;
/// Default duration of a blink, ms.
inline constexpr double blink_ms = usual_ramps[4].ramps.attack + usual_ramps[4].ramps.release;

/// Values of the lid FAPs with which performances close the eyes: the lids of a neutral face are one iris apart, 1024
/// units, of which the upper lid (FAPs 19 and 20) and the lower lid (21 and 22) move these.
inline constexpr double upper_lid_units = 940.0;
inline constexpr double lower_lid_units = 84.0;

/// How far performances turn an eye, sideways and up or down.
inline constexpr double largest_eye_yaw_degrees = 45.0;
inline constexpr double largest_eye_pitch_degrees = 35.0;

}  // namespace semblante

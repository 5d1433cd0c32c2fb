#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/performance/easing.h"

namespace semblante {

// ---- limits of a document, checked by Performance::compile
inline constexpr std::size_t max_performance_cues = 100'000;
inline constexpr std::size_t max_performance_keys = 1'000'000;  ///< of all cues together
inline constexpr std::size_t max_overlapping_cues = 64;         ///< on one target at one moment
inline constexpr double max_performance_ms = 86'400'000.0;      ///< a day

/// FAP 3 to 68, in FAP units (rotations: 1e-5 rad).
struct FapTarget {
  std::uint8_t fap = 0;
};
/// FAP 1: `value` is the weight of `viseme`, 1 - `value` that of `other`. Visemes 0..14; 0 is silence.
struct VisemeTarget {
  std::uint8_t viseme = 0;
  std::uint8_t other = 0;
};
/// FAP 2: 1..6, value 0..1.
struct ExpressionTarget {
  std::uint8_t expression = 0;
};
/// The target of the gaze, seen from the middle between the eyes at rest: yaw to the face's left and pitch down,
/// degrees (the signs of FAPs 23 to 26 and 48, 49); distance in eye distances (1024 ES), where the eyes converge.
struct LookTarget {
  double yaw = 0.0;
  double pitch = 0.0;
  double distance = std::numeric_limits<double>::infinity();
  double head_share = 0.25;  ///< 0..1 of the angles that the head takes
};
struct BlinkTarget {
  bool left = true;
  bool right = true;
};
/// Degrees, with the signs of FAPs 48 to 50: down, to the face's left, the face's left side up.
struct HeadTarget {
  double pitch = 0.0;
  double yaw = 0.0;
  double roll = 0.0;
};
using CueTarget = std::variant<FapTarget, VisemeTarget, ExpressionTarget, LookTarget, BlinkTarget, HeadTarget>;

/// A value at a time after the start of its cue.
struct CueKey {
  double time = 0.0;  ///< ms
  double value = 0.0;
  friend bool operator==(const CueKey&, const CueKey&) = default;
};

/// A motion of one target from `time` for `duration`: its weight rises during `attack`, stays 1, and falls during
/// `release`, both along `easing` (reversed for the release). Times are in milliseconds.
struct Cue {
  double time = 0.0;
  std::optional<double> duration;  ///< left out: the last key's time; 240 for a blink
  std::optional<double> attack, release;
  Easing easing;
  CueTarget target;
  double value = 1.0;        ///< in units of the target; looking and head have none
  std::vector<CueKey> keys;  ///< in place of value: times rise, `easing` leads from one to the next
};

/// Settings of idle life (blinks, glances, small head motions), a function of seed and time only.
struct IdleLife {
  std::uint32_t seed = 0;
  double blinks_per_minute = 15.0;  ///< 0..40
  double head = 0.3;                ///< 0..1 of the largest drift
  double eyes = 0.5;                ///< 0..1 of the largest glances aside
  friend bool operator==(const IdleLife&, const IdleLife&) = default;
};

/// A performance as written by its author. protocol/cpp/performance_document.h reads and writes the JSON form.
struct PerformanceScript {
  std::string name;
  std::optional<double> duration;  ///< ms; left out: when the last cue ends
  std::optional<IdleLife> idle;
  std::vector<Cue> cues;  ///< times do not fall
};

}  // namespace semblante

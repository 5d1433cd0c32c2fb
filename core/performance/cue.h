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

// ---- what a document may have; all of it is checked by Performance::compile
inline constexpr std::size_t max_performance_cues = 100'000;
inline constexpr std::size_t max_performance_keys = 1'000'000;  ///< of all cues together
inline constexpr std::size_t max_overlapping_cues = 64;         ///< on one target at one moment
inline constexpr double max_performance_ms = 86'400'000.0;      ///< a day

/// FAP 3 to 68, in FAP units (rotations: 1e-5 rad).
struct FapTarget {
  std::uint8_t fap = 0;
};
/// FAP 1: value of `viseme` and the rest of `other`, 0..14; 0 is silence.
struct VisemeTarget {
  std::uint8_t viseme = 0;
  std::uint8_t other = 0;
};
/// FAP 2: 1..6, value 0..1.
struct ExpressionTarget {
  std::uint8_t expression = 0;
};
/// Where the face looks, seen from the middle between its eyes at rest: yaw to its own left and pitch down in degrees,
/// as FAPs 23 to 26 and 48, 49 count; distance in eye distances (ES before its division by 1024), for the eyes to meet.
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
/// Degrees, as FAPs 48 to 50 count: down, to its own left, its own left side up.
struct HeadTarget {
  double pitch = 0.0;
  double yaw = 0.0;
  double roll = 0.0;
};
using CueTarget = std::variant<FapTarget, VisemeTarget, ExpressionTarget, LookTarget, BlinkTarget, HeadTarget>;

/// A value at a time after the beginning of its cue.
struct CueKey {
  double time = 0.0;  ///< ms
  double value = 0.0;
  friend bool operator==(const CueKey&, const CueKey&) = default;
};

/// One thing the face does from `time` for `duration`: its weight rises over `attack`, stays, and falls over `release`,
/// both along `easing` (the fall is the rise backwards). Times are in milliseconds.
struct Cue {
  double time = 0.0;
  std::optional<double> duration;  ///< left out: the last key's time; 240 for a blink
  std::optional<double> attack, release;
  Easing easing;
  CueTarget target;
  double value = 1.0;        ///< in units of the target; looking and head have none
  std::vector<CueKey> keys;  ///< in place of value: times rise, `easing` leads from one to the next
};

/// What a face does while nobody tells it to: a function of the seed and the time alone.
struct IdleLife {
  std::uint32_t seed = 0;
  double blinks_per_minute = 15.0;  ///< 0..40
  double head = 0.3;                ///< 0..1 of the largest drift
  double eyes = 0.5;                ///< 0..1 of the largest glances aside
  friend bool operator==(const IdleLife&, const IdleLife&) = default;
};

/// A performance as its author writes it. The JSON form is protocol/cpp/performance_document.h's.
struct PerformanceScript {
  std::string name;
  std::optional<double> duration;  ///< ms; left out: when the last cue ends
  std::optional<IdleLife> idle;
  std::vector<Cue> cues;  ///< times do not fall
};

}  // namespace semblante

#pragma once

#include "core/performance/cue.h"

namespace semblante {

/// What idle life adds at one moment. Degrees, as the FAPs count them.
struct IdleMotion {
  double lid_closure = 0.0;  ///< 0..1
  double eye_yaw = 0.0, eye_pitch = 0.0;
  double head_pitch = 0.0, head_yaw = 0.0, head_roll = 0.0;
};

/// A function of settings and time (ms, not negative) alone: the same on every machine, from wherever it starts.
/// Blinks come at irregular intervals, many short and few long, from a quarter to two and a half times (and a little
/// more) the mean; the eyes jump to small glances aside; the head drifts without corners, the eyes turning against it.
IdleMotion idle_at(const IdleLife& idle, double ms);

}  // namespace semblante

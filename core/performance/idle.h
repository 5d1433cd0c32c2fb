#pragma once

#include "core/performance/cue.h"

namespace semblante {

/// The motion that idle life adds at one moment. Degrees, with the signs of the FAPs.
struct IdleMotion {
  double lid_closure = 0.0;  ///< 0..1
  double eye_yaw = 0.0, eye_pitch = 0.0;
  double head_pitch = 0.0, head_yaw = 0.0, head_roll = 0.0;
};

/// A pure function of settings and time (ms, not negative): the same on every machine and for random access.
/// Blinks have irregular intervals, many short and few long, from a quarter to slightly more than two and a half times
/// the mean; the eyes jump to small glances sideways; the head drifts smoothly, and the eyes compensate for it.
IdleMotion idle_at(const IdleLife& idle, double ms);

}  // namespace semblante

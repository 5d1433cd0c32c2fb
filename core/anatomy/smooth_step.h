#pragma once

#include <algorithm>

namespace semblante {

/// 0 up to `from`, 1 beyond `to`, with a slope of 0 at both.
inline double smooth_step(double from, double to, double value) {
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// 0 up to `from`, 1 beyond `to`, with a slope of 0 at both: straight but for its ends, so that it is nowhere steeper
/// than 1.25 times the straight line (smooth_step: 1.5).
inline double rounded_ramp(double from, double to, double value) {
  constexpr double end = 0.2;  // of the way, at either side
  constexpr double slope = 1.0 / (1.0 - end);
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  if (t < end) return slope * t * t / (2.0 * end);
  if (t > 1.0 - end) return 1.0 - slope * (1.0 - t) * (1.0 - t) / (2.0 * end);
  return slope * (t - 0.5 * end);
}

}  // namespace semblante

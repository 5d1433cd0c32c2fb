#pragma once

#include <algorithm>

namespace semblante {

/// 0 up to `from`, 1 beyond `to`, with a slope of 0 at both.
inline double smooth_step(double from, double to, double value) {
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace semblante

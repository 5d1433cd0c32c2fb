#pragma once

#include <cstdint>

namespace semblante {

enum class EasingKind : std::uint8_t { linear, ease_in, ease_out, ease_in_out, step, bezier };

/// An easing function from 0 to 1. ease_in x^2, ease_out 1 - (1 - x)^2, ease_in_out x^2 (3 - 2x); step is 1 from the
/// start, and between two keys holds the first until the second; bezier is the curve from (0, 0) over (x1, y1)
/// and (x2, y2) to (1, 1), x1 and x2 within 0..1.
struct Easing {
  EasingKind kind = EasingKind::ease_in_out;
  double x1 = 0.0, y1 = 0.0, x2 = 1.0, y2 = 1.0;  ///< of a bezier
  friend bool operator==(const Easing&, const Easing&) = default;
};

/// 0 for x <= 0 (except step), 1 for x >= 1. Uses no libm: the same bits on all machines without fused operations.
double ease(const Easing& easing, double x);

/// x^2 (3 - 2x), clamped.
double smooth_step(double x);

}  // namespace semblante

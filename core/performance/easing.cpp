#include "core/performance/easing.h"

#include <algorithm>

namespace semblante {
namespace {

/// A coordinate of the curve with control values 0, a, b, 1.
double bezier(double a, double b, double s) {
  const double r = 1.0 - s;
  return 3.0 * r * r * s * a + 3.0 * r * s * s * b + s * s * s;
}

/// y of the curve at x. With control points within 0..1, x is monotonic, so bisection finds it.
double bezier_at(const Easing& easing, double x) {
  double low = 0.0;
  double high = 1.0;
  for (int round = 0; round < 40; ++round) {
    const double middle = 0.5 * (low + high);
    (bezier(easing.x1, easing.x2, middle) < x ? low : high) = middle;
  }
  return bezier(easing.y1, easing.y2, 0.5 * (low + high));
}

}  // namespace

double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

double ease(const Easing& easing, double x) {
  if (easing.kind == EasingKind::step || x >= 1.0) return 1.0;
  if (x <= 0.0) return 0.0;
  switch (easing.kind) {
    case EasingKind::ease_in:
      return x * x;
    case EasingKind::ease_out:
      return 1.0 - (1.0 - x) * (1.0 - x);
    case EasingKind::ease_in_out:
      return x * x * (3.0 - 2.0 * x);
    case EasingKind::bezier:
      return bezier_at(easing, x);
    case EasingKind::linear:
    case EasingKind::step:
      break;
  }
  return x;
}

}  // namespace semblante

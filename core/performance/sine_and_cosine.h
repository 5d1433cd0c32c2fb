#pragma once

#include <cmath>
#include <numbers>
#include <utility>

namespace semblante {

/// Sine and cosine of an angle of a few turns at most, to the last digit of a double or the one before. Those of the C
/// library take angles of any size, which costs 6 kB in each client that is downloaded.
inline std::pair<double, double> sine_and_cosine(double angle) {
  constexpr double quarter = std::numbers::pi / 2;
  const double turns = std::round(angle / quarter);
  const double x = angle - turns * quarter;
  double sine = x;
  double cosine = 1.0;
  double power = 1.0;  // (-1)^(n/2) x^n / n!
  for (int n = 2; n <= 16; n += 2) {
    power *= -x * x / (n * (n - 1));
    cosine += power;
    sine += power * x / (n + 1);
  }
  switch (static_cast<int>(turns) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace semblante

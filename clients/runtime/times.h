#pragma once

#include <cmath>
#include <limits>

/// Times and durations in ms, as doubles.
namespace semblante::runtime {

/// NaN: compares unequal to everything.
inline constexpr double unknown_time = std::numeric_limits<double>::quiet_NaN();
inline constexpr double never = std::numeric_limits<double>::infinity();

/// Times of a caller: finite, and small enough that sums stay exact to a microsecond.
inline bool is_time(double ms) { return std::abs(ms) <= 9e15; }

}  // namespace semblante::runtime

#pragma once

#include <array>

namespace semblante {

/// Opposite points of the inner lips that meet when the mouth closes: middle, left, right.
struct FacingLips {
  const char* upper;
  const char* lower;
};
inline constexpr std::array<FacingLips, 3> facing_lips = {{{"2.2", "2.3"}, {"2.6", "2.8"}, {"2.7", "2.9"}}};

/// The distance, along y, by which each pair must close until the lips of this head meet; model units, at least 0.
using LipGaps = std::array<double, facing_lips.size()>;

}  // namespace semblante

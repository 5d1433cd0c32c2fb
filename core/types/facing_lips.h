#pragma once

#include <array>

namespace semblante {

/// Points of the inner lips that face each other and meet when the mouth shuts: middle, left, right.
struct FacingLips {
  const char* upper;
  const char* lower;
};
inline constexpr std::array<FacingLips, 3> facing_lips = {{{"2.2", "2.3"}, {"2.6", "2.8"}, {"2.7", "2.9"}}};

/// How far each facing pair closes, along y, until the lips of this head meet; model units, none below zero.
using LipGaps = std::array<double, facing_lips.size()>;

}  // namespace semblante

#pragma once

#include <array>

namespace semblante {

/// Opposite points of the inner lips that meet when the mouth closes: middle, left, right.
struct FacingLips {
  const char* upper;
  const char* lower;
};
inline constexpr std::array<FacingLips, 3> facing_lips = {{{"2.2", "2.3"}, {"2.6", "2.8"}, {"2.7", "2.9"}}};

/// How far the lips of a head close.
struct LipGaps {
  /// The distance, along y, by which each pair must close until the lips meet; model units, at least 0.
  std::array<double, facing_lips.size()> closing{};
  /// The lips are one skin without an opening, which closes by so much before it folds over itself, and does not yield.
  bool joined = false;
};

}  // namespace semblante

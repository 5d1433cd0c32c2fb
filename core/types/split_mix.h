#pragma once

#include <cstdint>

namespace semblante {

/// Random numbers by splitmix64: one seed gives the same numbers on every platform.
class SplitMix {
 public:
  explicit SplitMix(std::uint64_t seed) : state_(seed) {}

  /// 0 to 1, without 1.
  double next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t bits = state_;
    bits = (bits ^ bits >> 30U) * 0xBF58476D1CE4E5B9U;
    bits = (bits ^ bits >> 27U) * 0x94D049BB133111EBU;
    bits ^= bits >> 31U;
    return static_cast<double>(bits >> 11U) * 0x1p-53;
  }
  double between(double least, double most) { return least + next() * (most - least); }

 private:
  std::uint64_t state_;
};

}  // namespace semblante

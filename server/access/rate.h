#pragma once

#include <algorithm>
#include <chrono>

namespace semblante::access {

/// A number of events per second, with bursts. The caller guards it.
class Rate {
 public:
  using Clock = std::chrono::steady_clock;

  Rate(double per_second, double burst) : per_second_(per_second), burst_(burst), left_(burst) {}

  /// Takes one event; false when the rate is used up.
  bool take(Clock::time_point now) {
    left_ = left(now);
    last_ = std::max(last_, now);
    if (left_ < 1.0) return false;
    left_ -= 1.0;
    return true;
  }
  [[nodiscard]] bool has_one(Clock::time_point now) const { return left(now) >= 1.0; }
  /// True when no event was taken for so long that a new object would behave the same.
  [[nodiscard]] bool is_full(Clock::time_point now) const { return left(now) >= burst_; }

 private:
  [[nodiscard]] double left(Clock::time_point now) const {
    const std::chrono::duration<double> passed = now - last_;
    return std::min(burst_, left_ + std::max(0.0, passed.count()) * per_second_);
  }

  double per_second_, burst_, left_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace semblante::access

#pragma once

#include <algorithm>
#include <chrono>

namespace semblante {

/// A limit of events per second on average, with bursts. Not synchronized.
class TokenBucket {
 public:
  using Clock = std::chrono::steady_clock;

  TokenBucket(double per_second, double burst, Clock::time_point now = Clock::now())
      : per_second_(per_second), burst_(burst), left_(burst), last_(now) {}

  /// Takes so many at once; false, and nothing is taken, when there are fewer.
  bool take(double count, Clock::time_point now) {
    left_ = left(now);
    last_ = std::max(last_, now);
    if (left_ < count) return false;
    left_ -= count;
    return true;
  }
  [[nodiscard]] bool has(double count, Clock::time_point now) const { return left(now) >= count; }
  /// True when nothing was taken for so long that a new object would behave the same.
  [[nodiscard]] bool is_full(Clock::time_point now) const { return left(now) >= burst_; }

 private:
  [[nodiscard]] double left(Clock::time_point now) const {
    const std::chrono::duration<double> passed = now - last_;
    return std::min(burst_, left_ + std::max(0.0, passed.count()) * per_second_);
  }

  double per_second_, burst_, left_;
  Clock::time_point last_;
};

}  // namespace semblante

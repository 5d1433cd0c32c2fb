#pragma once

#include <algorithm>

namespace semblante::gateways {

/// A limit per second on average, with a burst of a quarter of a second's amount. Times are seconds of any monotonic
/// clock.
class RateLimit {
 public:
  explicit RateLimit(double per_second)
      : per_second_(per_second), most_(std::max(1.0, per_second / 4.0)), there_(most_) {}

  bool admits(double now) {
    there_ = std::min(most_, there_ + std::max(0.0, now - last_) * per_second_);
    last_ = now;
    if (there_ < 1.0) return false;
    there_ -= 1.0;
    return true;
  }

 private:
  double per_second_, most_, there_;
  double last_ = 0.0;
};

}  // namespace semblante::gateways

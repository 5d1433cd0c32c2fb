#pragma once

#include <algorithm>

namespace semblante::gateways {

/// So many a second on average, and a quarter of a second's worth at once. Times are seconds of any clock that does not
/// fall.
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

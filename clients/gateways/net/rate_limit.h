#pragma once

#include <algorithm>
#include <chrono>

#include "core/types/token_bucket.h"

namespace semblante::gateways {

/// A limit per second on average, with a burst of a quarter of a second's amount. Times are seconds of any monotonic
/// clock.
class RateLimit {
 public:
  explicit RateLimit(double per_second) : bucket_(per_second, std::max(1.0, per_second / 4.0), at(0.0)) {}

  bool admits(double now) { return bucket_.take(1.0, at(now)); }

 private:
  using Clock = TokenBucket::Clock;
  static Clock::time_point at(double seconds) {
    return Clock::time_point(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds)));
  }

  TokenBucket bucket_;
};

}  // namespace semblante::gateways

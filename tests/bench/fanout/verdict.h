#pragma once

#include <string>

#include "tests/bench/fanout/subscriber_pool.h"

namespace semblante::bench {

/// What must hold, and whether it did. Prints each failure when it is found.
class Verdict {
 public:
  void expect(bool held, const std::string& otherwise);
  /// Every subscriber there still is has had everything since begin_measuring(), which is something, and its own
  /// decoder agrees.
  void expect_whole(SubscriberPool& pool, const Timeline& timeline, const std::string& when);
  [[nodiscard]] int status() const { return broken_ ? 1 : 0; }

 private:
  bool broken_ = false;
};

/// "p50 1.2, p99 3.4, p99.9 5.6, max 7.8 ms"
std::string words(const Histogram& histogram);

}  // namespace semblante::bench

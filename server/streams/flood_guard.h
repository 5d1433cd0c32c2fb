#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/types/token_bucket.h"

namespace semblante::streams {

struct FloodLimits {
  std::uint32_t frames_per_second = 500;  ///< of one source, on average
  std::uint32_t frames_burst = 2000;
  std::chrono::milliseconds flood{10'000};  ///< a source that exceeds the limit for this time without a pause is closed
};

/// Limits the frames of one source by a token bucket. Frames over the limit are dropped. The source is told immediately
/// and then once per second, not once per message, so that a flood of frames does not cause a flood of answers. Not
/// synchronized.
class FloodGuard {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Verdict {
    take,
    drop,          ///< drop them silently, because the source was told less than a second ago
    drop_and_say,  ///< drop them and send words()
    close,         ///< the flood has lasted too long
  };

  FloodGuard(FloodLimits limits, Clock::time_point now)
      : limits_(limits), bucket_(limits.frames_per_second, limits.frames_burst, now) {}

  Verdict offer(std::size_t frames, Clock::time_point now);
  /// A message with the limit and the number of frames dropped since the last call.
  [[nodiscard]] std::string words();

 private:
  FloodLimits limits_;
  TokenBucket bucket_;
  Clock::time_point began_, last_drop_;  ///< of the current or last flood
  Clock::time_point last_said_;
  bool dropped_ = false, said_ = false;  ///< ever
  std::uint64_t unsaid_frames_ = 0, unsaid_messages_ = 0;
};

}  // namespace semblante::streams

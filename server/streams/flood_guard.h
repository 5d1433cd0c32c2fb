#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace semblante::streams {

struct FloodLimits {
  std::uint32_t frames_per_second = 500;  ///< of one source, on average
  std::uint32_t frames_burst = 2000;
  std::chrono::milliseconds flood{10'000};  ///< a source that sends too much for so long without a pause is closed
};

/// Limits the frames of one source by a token bucket. Frames over the limit are left out. The source is told at once,
/// and then once a second instead of once a message, so that a flood is not answered by another one. Not synchronized.
class FloodGuard {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Verdict {
    take,
    drop,          ///< leave them out and say nothing, because it was said less than a second ago
    drop_and_say,  ///< leave them out and say words()
    close,         ///< the flood has lasted too long
  };

  FloodGuard(FloodLimits limits, Clock::time_point now)
      : limits_(limits), tokens_(limits.frames_burst), counted_(now) {}

  Verdict offer(std::size_t frames, Clock::time_point now);
  /// Names the limit, and how much was left out since the last call.
  [[nodiscard]] std::string words();

 private:
  FloodLimits limits_;
  double tokens_;
  Clock::time_point counted_;            ///< when tokens_ was updated
  Clock::time_point began_, last_drop_;  ///< of the flood that lasts, or lasted last
  Clock::time_point last_said_;
  bool dropped_ = false, said_ = false;  ///< has happened at all
  std::uint64_t unsaid_frames_ = 0, unsaid_messages_ = 0;
};

}  // namespace semblante::streams

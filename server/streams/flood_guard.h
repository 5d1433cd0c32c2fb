#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace semblante::streams {

struct FloodLimits {
  std::uint32_t frames_per_second = 500;  ///< of one publisher, on average
  std::uint32_t frames_burst = 2000;
  std::chrono::milliseconds flood{10'000};  ///< of frames left out, without a pause: then it is closed
};

/// Holds a source to a number of frames a second. What is too much is left out; the source hears of it at once, and
/// then once a second, not once a message: who sends ten thousand messages a second needs no ten thousand answers. Not
/// for several threads.
class FloodGuard {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Verdict {
    take,
    drop,          ///< leave them out and say nothing: it was said less than a second ago
    drop_and_say,  ///< leave them out and say words()
    close,         ///< it has gone on for too long
  };

  FloodGuard(FloodLimits limits, Clock::time_point now)
      : limits_(limits), tokens_(limits.frames_burst), counted_(now) {}

  Verdict offer(std::size_t frames, Clock::time_point now);
  /// The limit, and what was left out since it was said last.
  [[nodiscard]] std::string words();

 private:
  FloodLimits limits_;
  double tokens_;
  Clock::time_point counted_;            ///< when the tokens were
  Clock::time_point began_, last_drop_;  ///< of what has been left out without a pause
  Clock::time_point last_said_;
  bool dropped_ = false, said_ = false;  ///< ever
  std::uint64_t unsaid_frames_ = 0, unsaid_messages_ = 0;
};

}  // namespace semblante::streams

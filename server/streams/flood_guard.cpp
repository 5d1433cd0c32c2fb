#include "server/streams/flood_guard.h"

namespace semblante::streams {
namespace {

/// A flood has ended when no frame was dropped for this time; also the minimum interval of messages about one flood.
constexpr std::chrono::milliseconds pause{1000};

}  // namespace

FloodGuard::Verdict FloodGuard::offer(std::size_t frames, Clock::time_point now) {
  if (bucket_.take(static_cast<double>(frames), now)) return Verdict::take;
  if (!dropped_ || now - last_drop_ > pause) began_ = now;
  dropped_ = true;
  last_drop_ = now;
  unsaid_frames_ += frames;
  ++unsaid_messages_;
  if (now - began_ >= limits_.flood) return Verdict::close;
  if (said_ && now - last_said_ < pause) return Verdict::drop;
  said_ = true;
  last_said_ = now;
  return Verdict::drop_and_say;
}

std::string FloodGuard::words() {
  std::string text = "more than " + std::to_string(limits_.frames_per_second) + " frames per second, or " +
                     std::to_string(limits_.frames_burst) + " at once: " + std::to_string(unsaid_frames_) +
                     " frames in " + std::to_string(unsaid_messages_) + " messages were left out";
  unsaid_frames_ = 0;
  unsaid_messages_ = 0;
  return text;
}

}  // namespace semblante::streams

#pragma once

#include <cstdint>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/face_frame.h"

namespace semblante::streams {

/// Nobody's frames lie farther ahead of the stream's clock than this, ms: so long at most does a new source wait until
/// what the one before it has sent already has been played.
inline constexpr std::uint64_t most_ahead = 10'000;
/// A publisher whose clock falls behind the stream's by more is set anew, ms.
inline constexpr std::uint64_t most_behind = 1'000;

/// Where the frames of all sources come to lie on one stream's clock, in whole ms. Whoever sends, and whatever their
/// clocks say: no frame is before the one before it. Not for several threads.
class Timeline {
 public:
  /// Of the newest frame; 0 before the first.
  [[nodiscard]] std::uint64_t newest() const { return newest_; }

  /// The next publisher has a clock of its own.
  void forget_publisher() { offset_known_ = false; }

  /// Frames without a time of their own happen now, or after the newest if that is ahead. Their spacing is kept. The
  /// time of their message. Errors: `out_of_range` at /frames/N/time if they last longer than most_ahead, `too_large`
  /// if they would end farther ahead because of those that came before: later there is room.
  Result<std::uint64_t> place_now(std::uint64_t now, const std::vector<TimedFrame>& frames);

  /// Frames of a publisher's own clock: their spacing is kept, but for what would fall before the newest, which gets
  /// its time. The publisher's clock is set anew, so that this message begins now, when it is too far ahead or behind.
  /// The time of their message; times of the frames are changed as needed. Errors: `out_of_range` as place_now.
  Result<std::uint64_t> place_published(std::uint64_t now, std::uint64_t media_time, std::vector<TimedFrame>& frames);

  /// One frame that is due at `when`.
  std::uint64_t place_due(std::uint64_t when);

 private:
  std::uint64_t newest_ = 0;
  std::int64_t offset_ = 0;  ///< stream clock minus the publisher's
  bool offset_known_ = false;
};

}  // namespace semblante::streams

#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/face_frame.h"

namespace semblante::streams {

/// No frame may lie farther ahead of the stream's clock than this, ms. It is the longest time for which the frames of a
/// new source wait until those that the source before it sent in advance have been played.
inline constexpr std::uint64_t most_ahead = 10'000;
/// The offset of a publisher's clock is measured anew when its frames fall behind the stream's clock by more, ms.
inline constexpr std::uint64_t most_behind = 1'000;

/// The stream's clock: whole ms since it began, 0 before.
std::uint64_t media_time_at(std::chrono::steady_clock::time_point began, std::chrono::steady_clock::time_point when);

/// ms since 1970-01-01 UTC.
double server_time_now();

/// Gives the frames of all sources their media times on one stream's clock, in whole ms. Media time never falls from
/// one frame to the next, whatever the clocks of the sources say. Not synchronized.
class Timeline {
 public:
  /// Media time of the newest frame; 0 before the first.
  [[nodiscard]] std::uint64_t newest() const { return newest_; }

  /// The next publisher has another clock, whose offset is not known.
  void forget_publisher() { offset_known_ = false; }

  /// Places frames without a clock of their own: now, or at the newest frame if that is ahead. Their spacing is kept.
  /// Returns the media time of their message. Errors: `out_of_range` at /frames/N/time if they last longer than
  /// most_ahead; `too_large` if they would end farther ahead because of earlier frames: later there is room.
  Result<std::uint64_t> place_now(std::uint64_t now, const std::vector<TimedFrame>& frames);

  /// Places frames with times of a publisher's clock. Their spacing is kept, but a frame that would fall before the
  /// newest one gets that one's time. When the message would be too far ahead or behind, the offset of the publisher's
  /// clock is set so that it begins now. Returns the media time of the message and changes the frames' times as needed.
  /// Errors: `out_of_range` as place_now.
  Result<std::uint64_t> place_published(std::uint64_t now, std::uint64_t media_time, std::vector<TimedFrame>& frames);

  /// Places one frame that is due at `when`: then, or at the newest frame's time if that is later.
  std::uint64_t place_due(std::uint64_t when);

 private:
  std::uint64_t newest_ = 0;
  std::int64_t offset_ = 0;  ///< stream clock minus the publisher's
  bool offset_known_ = false;
};

}  // namespace semblante::streams

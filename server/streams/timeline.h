#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/face_frame.h"

namespace semblante::streams {

/// Maximum time by which a frame may be ahead of the stream's clock, ms. This also bounds how long the frames of a new
/// source wait behind frames that the previous source sent in advance.
inline constexpr std::uint64_t most_ahead = 10'000;
/// When frames are behind the stream's clock by more than this, ms, the offset of the publisher's clock is set again.
inline constexpr std::uint64_t most_behind = 1'000;

/// The stream's clock: whole ms since its start; 0 before the start.
std::uint64_t media_time_at(std::chrono::steady_clock::time_point began, std::chrono::steady_clock::time_point when);

/// ms since 1970-01-01 UTC; 0 by a clock that is set before.
double server_time_now();

/// Assigns media times on the stream's clock, whole ms, to the frames of all sources. Media time never decreases from
/// one frame to the next, independent of the sources' clocks. Not synchronized.
class Timeline {
 public:
  /// Media time of the newest frame; 0 before the first.
  [[nodiscard]] std::uint64_t newest() const { return newest_; }

  /// Forgets the offset of the publisher's clock: the next publisher has another clock.
  void forget_publisher() { offset_known_ = false; }

  /// Places frames without a clock: now, or at the time of the newest frame if that is later. Keeps their spacing.
  /// Returns the media time of their message. Errors: `out_of_range` at /frames/N/time if they last longer than
  /// most_ahead; `too_large` if they would end farther ahead because of earlier frames (a later retry can succeed).
  Result<std::uint64_t> place_now(std::uint64_t now, const std::vector<TimedFrame>& frames);

  /// Places frames with times of a publisher's clock. Keeps their spacing, but a frame that would precede the newest
  /// one gets the newest one's time. If the message would be too far ahead or behind, sets the offset of the
  /// publisher's clock so that it begins now. Returns the media time of the message and changes the frames' times as
  /// needed. Errors: `out_of_range` like place_now.
  Result<std::uint64_t> place_published(std::uint64_t now, std::uint64_t media_time, std::vector<TimedFrame>& frames);

  /// Places one frame that is due at `when`: at `when`, or at the newest frame's time if that is later.
  std::uint64_t place_due(std::uint64_t when);

  /// Places a packet of sound of `lasts` ms with a time of a publisher's clock, which is the clock of its frames.
  /// nullopt, and the packet is to be dropped, when the sound before it has not ended: that of an earlier source.
  std::optional<std::uint64_t> place_published_sound(std::uint64_t now, std::uint64_t media_time, double lasts);
  /// A packet of a player's sound, whose times are the stream's.
  void sound_played(std::uint64_t media_time, double lasts) { sound_ends_ = static_cast<double>(media_time) + lasts; }

 private:
  /// A time of the publisher's clock on the stream's. Sets the offset when there is none, or when what begins then and
  /// ends `lasts` ms later would be too far ahead or behind: it then begins now.
  std::int64_t on_stream_clock(std::uint64_t now, std::uint64_t media_time, std::uint64_t lasts);

  std::uint64_t newest_ = 0;
  double sound_ends_ = 0.0;  ///< ms; of the newest packet
  std::int64_t offset_ = 0;  ///< stream clock minus the publisher's
  bool offset_known_ = false;
};

}  // namespace semblante::streams

#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

#include "clients/native/client/live_stream.h"
#include "clients/runtime/player.h"
#include "core/kernel/semblante_kernel.h"
#include "core/types/result.h"
#include "protocol/cpp/messages.h"

namespace semblante::client {

/// A state and its time.
struct PlayedFrame {
  std::uint64_t sequence = 0;
  double media_time = 0;  ///< ms
  semblante_frame frame{};
};

/// The frame to show: at the fraction t between `from` and `to`.
struct DisplayedFrame {
  PlayedFrame from, to;
  float t = 0;
  double media_time = 0;  ///< ms
};

/// What a player shows now.
DisplayedFrame displayed(const runtime::Player& player);

/// The frames of a subscription, one by one or at a display's own rate, for programs that wait for them. Reads the
/// stream as needed.
class FramePlayer {
 public:
  /// `stream` must outlive the player. `patience`: timeout of a frame.
  FramePlayer(LiveStream& stream, std::chrono::milliseconds patience);

  /// The next frame the stream sends (a keyframe counts as one); nullopt when the stream has ended. Of each frame, and
  /// of each time, there is one, also after a lost connection.
  /// Errors: io (late, or no connection to begin with), mismatch and the like from the server's own error messages.
  Result<std::optional<PlayedFrame>> next_received();

  /// The face at `media_time`, which must not decrease from call to call; before the first frame it is the first frame.
  /// nullopt when the stream ended before that time.
  Result<std::optional<DisplayedFrame>> at(double media_time);

  /// Of the stream; empty before the first message.
  [[nodiscard]] const std::optional<Header>& header() const { return stream_.header(); }
  /// Reads until the header has been received.
  Status wait_for_header();

 private:
  /// Reads until an event of the stream that is not only about clocks and states. False when the stream has ended.
  Result<bool> pump();
  /// The newest frames of the stream.
  void take();

  LiveStream& stream_;
  std::chrono::milliseconds patience_;
  runtime::Player player_;
  std::deque<PlayedFrame> received_;
  std::optional<PlayedFrame> newest_;
  std::uint64_t epoch_ = 0;  ///< of `newest_`
};

}  // namespace semblante::client

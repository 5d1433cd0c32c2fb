#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

#include "clients/native/client/stream_client.h"
#include "core/kernel/semblante_kernel.h"
#include "core/types/result.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/quantizers.h"

namespace semblante::client {

/// A state and when it holds.
struct PlayedFrame {
  std::uint64_t sequence = 0;
  double media_time = 0;  ///< ms
  semblante_frame frame{};
};

/// What to show: `from` and `to` with the share t of the way between.
struct DisplayedFrame {
  PlayedFrame from, to;
  float t = 0;
  double media_time = 0;  ///< ms
};

/// Turns a subscriber's messages into frames, one by one or at a display's own rate. Reads the stream as it needs to.
class FramePlayer {
 public:
  /// `stream` must outlive the player. `patience`: how long a frame may be in coming.
  FramePlayer(StreamClient& stream, std::chrono::milliseconds patience) : stream_(stream), patience_(patience) {}

  /// The next frame the stream sends (a keyframe counts as one); nullopt when the stream has ended.
  /// Errors: io (late or closed), mismatch and the like from the server's own error messages.
  Result<std::optional<PlayedFrame>> next_received();

  /// The face at `media_time`, which must not fall from call to call; before the first frame it is the first frame.
  /// nullopt when the stream ended before that time.
  Result<std::optional<DisplayedFrame>> at(double media_time);

  /// Of the stream; empty before the first message.
  [[nodiscard]] const std::optional<Header>& header() const { return header_; }
  /// Reads until the header is there.
  Status wait_for_header();

 private:
  /// Reads one message. False when the stream has ended.
  Result<bool> pump();
  void take(std::uint64_t sequence, double media_time, const FaceFrame& state);

  StreamClient& stream_;
  std::chrono::milliseconds patience_;
  std::optional<Header> header_;
  QuantizerSteps steps_ = standard_quantizers();
  std::deque<PlayedFrame> received_;
  std::optional<PlayedFrame> before_;  ///< of at(): the newest that is not after the asked time
};

}  // namespace semblante::client

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

/// Converts a subscriber's messages to frames, one by one or at a display's own rate. Reads the stream as needed.
class FramePlayer {
 public:
  /// `stream` must outlive the player. `patience`: timeout of a frame.
  FramePlayer(StreamClient& stream, std::chrono::milliseconds patience) : stream_(stream), patience_(patience) {}

  /// The next frame the stream sends (a keyframe counts as one); nullopt when the stream has ended.
  /// Errors: io (late or closed), mismatch and the like from the server's own error messages.
  Result<std::optional<PlayedFrame>> next_received();

  /// The face at `media_time`, which must not decrease from call to call; before the first frame it is the first frame.
  /// nullopt when the stream ended before that time.
  Result<std::optional<DisplayedFrame>> at(double media_time);

  /// Of the stream; empty before the first message.
  [[nodiscard]] const std::optional<Header>& header() const { return header_; }
  /// Reads until the header has been received.
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
  std::optional<PlayedFrame> before_;  ///< of at(): the newest frame not after the requested time
};

}  // namespace semblante::client

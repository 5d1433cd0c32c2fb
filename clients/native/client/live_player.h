#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>

#include "clients/native/client/frame_player.h"
#include "clients/native/client/live_stream.h"
#include "clients/native/client/playout.h"

namespace semblante::client {

/// Plays a live stream: selects the frame to show at each display frame, across losses of the connection, by the
/// stream's clock minus a delay (`Playout`). For one thread.
class LivePlayer {
 public:
  LivePlayer(Url url, std::string stream, LiveStreamOptions options = {}, const PlayoutOptions& playout = {});

  /// Receives messages for `time`; call it with the time until the next display frame. Errors like LiveStream::next.
  Status receive(std::chrono::milliseconds time);
  /// The frame to show now; nullopt before the first frame.
  std::optional<DisplayedFrame> show();

  [[nodiscard]] const LiveStream& stream() const { return stream_; }
  [[nodiscard]] const Playout& playout() const { return playout_; }

 private:
  struct Held {
    PlayedFrame frame;
    double begin = 0;  ///< media time at which the motion towards it begins
  };
  void take(const Message& message);
  void push(std::uint64_t sequence, std::uint64_t media_time, std::span<const TimedFrame> frames);

  LiveStream stream_;
  Playout playout_;
  QuantizerSteps steps_ = standard_quantizers();
  std::deque<Held> held_;  ///< the first is the newest frame not after the playhead
  double shown_at_ = 0;
};

}  // namespace semblante::client

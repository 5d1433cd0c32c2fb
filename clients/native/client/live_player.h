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

/// A stream as it happens: what to show at each display frame, over losses of the connection, by the stream's clock
/// less a delay (`Playout`). For one thread.
class LivePlayer {
 public:
  LivePlayer(Url url, std::string stream, LiveStreamOptions options = {}, const PlayoutOptions& playout = {});

  /// Receives for that long; call it with the time until the next display frame. Errors as LiveStream::next.
  Status receive(std::chrono::milliseconds time);
  /// What to show now; nullopt before the first frame.
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
  std::deque<Held> held_;  ///< the first is the newest that is not after the playhead
  double shown_at_ = 0;
};

}  // namespace semblante::client

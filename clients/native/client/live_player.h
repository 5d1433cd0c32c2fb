#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "clients/native/client/frame_player.h"
#include "clients/native/client/live_stream.h"
#include "clients/runtime/player.h"

namespace semblante::client {

/// Plays a live stream: a `runtime::Player` that follows a `LiveStream`. For one thread.
class LivePlayer {
 public:
  LivePlayer(ServerAddress server, std::string stream, LiveStreamOptions options = {},
             const runtime::PlayoutOptions& playout = {});

  /// Receives messages for `time`; call it with the time until the next display frame. Errors like LiveStream::next.
  Status receive(std::chrono::milliseconds time);
  /// The frame to show now; nullopt before the first frame.
  std::optional<DisplayedFrame> show();

  [[nodiscard]] const LiveStream& stream() const { return stream_; }
  [[nodiscard]] const runtime::Playout& playout() const { return player_.playout(); }

 private:
  LiveStream stream_;
  runtime::Player player_;
};

}  // namespace semblante::client

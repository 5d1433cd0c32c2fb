#include "clients/native/client/live_player.h"

#include <algorithm>
#include <utility>

namespace semblante::client {

LivePlayer::LivePlayer(ServerAddress server, std::string stream, LiveStreamOptions options,
                       const runtime::PlayoutOptions& playout)
    : stream_(std::move(server), std::move(stream), options), player_({.playout = playout}) {
  player_.follow(&stream_.machine());
}

Status LivePlayer::receive(std::chrono::milliseconds time) {
  const auto deadline = LiveStream::Clock::now() + time;
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - LiveStream::Clock::now());
    auto message = stream_.next(std::max(left, std::chrono::milliseconds(0)));
    if (!message) {
      return std::move(message).error();
    }
    if (!*message) {
      return Unit{};
    }
  }
}

std::optional<DisplayedFrame> LivePlayer::show() {
  constexpr double by_the_clock = -1;
  if (!player_.advance(LiveStream::now(), by_the_clock)) {
    return std::nullopt;
  }
  const runtime::Moment& moment = player_.moment();
  return DisplayedFrame{{moment.from_sequence, moment.from_time, moment.frames[1]},
                        {moment.to_sequence, moment.to_time, moment.frames[2]},
                        moment.t,
                        player_.playout().playhead()};
}

}  // namespace semblante::client

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
    auto event = stream_.next(std::max(left, std::chrono::milliseconds(0)));
    if (!event) {
      return std::move(event).error();
    }
    if (event->type == SEMBLANTE_EVENT_NONE) {
      return Unit{};
    }
  }
}

std::optional<DisplayedFrame> LivePlayer::show() {
  constexpr double by_the_clock = -1;
  if (!player_.advance(LiveStream::now(), by_the_clock)) {
    return std::nullopt;
  }
  return displayed(player_);
}

}  // namespace semblante::client

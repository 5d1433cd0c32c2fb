#include "clients/native/client/frame_player.h"

#include <utility>

namespace semblante::client {

DisplayedFrame displayed(const runtime::Player& player) {
  const runtime::Moment& moment = player.moment();
  return {{moment.from_sequence, moment.from_time, moment.frames[1]},
          {moment.to_sequence, moment.to_time, moment.frames[2]},
          moment.t,
          player.playout().playhead()};
}

FramePlayer::FramePlayer(LiveStream& stream, std::chrono::milliseconds patience)
    : stream_(stream), patience_(patience), player_(runtime::PlayerOptions{}) {
  player_.follow(&stream.machine());
}

void FramePlayer::take() {
  if (header()->epoch != epoch_) newest_.reset();
  epoch_ = header()->epoch;
  std::uint64_t sequence = stream_.machine().newest().sequence;
  for (const semblante_timed_frame& each : stream_.machine().frames()) {
    const PlayedFrame frame{sequence++, each.time, each.frame};
    if (newest_ && frame.sequence <= newest_->sequence) continue;  // sent again after a lost connection
    newest_ = frame;
    received_.push_back(frame);
  }
}

Result<bool> FramePlayer::pump() {
  const auto deadline = LiveStream::Clock::now() + patience_;
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - LiveStream::Clock::now());
    auto event = stream_.next(std::max(left, std::chrono::milliseconds(0)));
    if (!event) return std::move(event).error();
    switch (event->type) {
      case SEMBLANTE_EVENT_KEYFRAME:
      case SEMBLANTE_EVENT_FRAMES:
        take();
        return true;
      case SEMBLANTE_EVENT_HEADER:
        return true;
      case SEMBLANTE_EVENT_REFUSED:
        return Error{
            event->code == static_cast<std::uint32_t>(StreamErrorCode::not_found) ? ErrorCode::missing : ErrorCode::io,
            "stream" + event->error->where, "error of the server: " + event->error->message};
      case SEMBLANTE_EVENT_FAULT:
        if (event->error->code != ErrorCode::io) return std::move(*event->error);
        break;  // a silent server: its connection is lost
      case SEMBLANTE_EVENT_END:
        if (event->is_final) return false;
        break;  // a server that stops starts again
      default:
        break;
    }
    // A lost connection comes back; one that was never there is a mistake of the caller's.
    if (!header() && stream_.loss()) return *stream_.loss();
    if (event->type == SEMBLANTE_EVENT_NONE) {
      return Error{ErrorCode::io, "stream",
                   "no message for " + std::to_string(patience_.count()) + " ms" +
                       (stream_.loss() ? ": " + stream_.loss()->message : "")};
    }
  }
}

Status FramePlayer::wait_for_header() {
  while (!header()) {
    auto more = pump();
    if (!more) return std::move(more).error();
    if (!*more) return Error{ErrorCode::io, "stream", "the stream ended before its header"};
  }
  return Unit{};
}

Result<std::optional<PlayedFrame>> FramePlayer::next_received() {
  while (received_.empty()) {
    auto more = pump();
    if (!more) return std::move(more).error();
    if (!*more) return std::optional<PlayedFrame>();
  }
  const PlayedFrame frame = received_.front();
  received_.pop_front();
  return std::optional(frame);
}

Result<std::optional<DisplayedFrame>> FramePlayer::at(double media_time) {
  while (!newest_ || newest_->media_time < media_time) {
    auto more = pump();
    if (!more) return std::move(more).error();
    if (!*more) return std::optional<DisplayedFrame>();
    received_.clear();  // the player holds them
  }
  player_.move_to(media_time);
  return std::optional(displayed(player_));
}

}  // namespace semblante::client

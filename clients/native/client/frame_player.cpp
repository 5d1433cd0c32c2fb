#include "clients/native/client/frame_player.h"

#include <utility>

#include "clients/native/client/kernel_frame.h"

namespace semblante::client {

void FramePlayer::take(std::uint64_t sequence, double media_time, const FaceFrame& state) {
  received_.push_back({sequence, media_time, to_kernel_frame(state, steps_)});
}

Result<bool> FramePlayer::pump() {
  auto received = stream_.next(patience_);
  if (!received) {
    return std::move(received).error();
  }
  if (!*received) {
    return Error{ErrorCode::io, "stream", "no message for " + std::to_string(patience_.count()) + " ms"};
  }
  const Message& message = **received;
  if (const auto* header = std::get_if<Header>(&message)) {
    header_ = *header;
    steps_ = quantizers_of(*header);
  } else if (const auto* keyframe = std::get_if<Keyframe>(&message)) {
    take(keyframe->sequence, static_cast<double>(keyframe->media_time), keyframe->state);
  } else if (const auto* frames = std::get_if<Frames>(&message)) {
    for (std::size_t i = 0; i < frames->frames.size(); ++i) {
      take(frames->sequence + i, static_cast<double>(frames->media_time) + frames->frames[i].time,
           frames->frames[i].state);
    }
  } else if (const auto* error = std::get_if<StreamError>(&message)) {
    return Error{error->code == StreamErrorCode::not_found ? ErrorCode::missing : ErrorCode::io,
                 "stream" + error->where, "error of the server: " + error->message};
  } else if (std::holds_alternative<End>(message)) {
    return false;
  }
  return true;
}

Status FramePlayer::wait_for_header() {
  while (!header_) {
    auto more = pump();
    if (!more) {
      return std::move(more).error();
    }
    if (!*more) {
      return Error{ErrorCode::io, "stream", "the stream ended before its header"};
    }
  }
  return Unit{};
}

Result<std::optional<PlayedFrame>> FramePlayer::next_received() {
  while (received_.empty()) {
    auto more = pump();
    if (!more) {
      return std::move(more).error();
    }
    if (!*more) {
      return std::optional<PlayedFrame>();
    }
  }
  const PlayedFrame frame = received_.front();
  received_.pop_front();
  return std::optional(frame);
}

Result<std::optional<DisplayedFrame>> FramePlayer::at(double media_time) {
  while (true) {
    while (!received_.empty() && received_.front().media_time <= media_time) {
      before_ = received_.front();
      received_.pop_front();
    }
    if (!received_.empty()) {
      const PlayedFrame& after = received_.front();
      const PlayedFrame& from = before_ ? *before_ : after;
      const double span = after.media_time - from.media_time;
      const double t = span > 0 ? (media_time - from.media_time) / span : 1.0;
      return std::optional(DisplayedFrame{from, after, static_cast<float>(t), media_time});
    }
    auto more = pump();
    if (!more) {
      return std::move(more).error();
    }
    if (!*more) {
      return std::optional<DisplayedFrame>();
    }
  }
}

}  // namespace semblante::client

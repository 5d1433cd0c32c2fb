#include "clients/native/client/live_player.h"

#include <algorithm>
#include <span>
#include <utility>
#include <variant>

#include "clients/native/client/kernel_frame.h"

namespace semblante::client {
namespace {

/// Limit of the frames kept while nothing is shown: only the newest matter when display resumes.
constexpr std::size_t max_held_frames = 2048;

}  // namespace

LivePlayer::LivePlayer(Url url, std::string stream, LiveStreamOptions options, const PlayoutOptions& playout)
    : stream_(std::move(url), std::move(stream), options), playout_(playout) {}

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
    take(**message);
  }
}

void LivePlayer::take(const Message& message) {
  if (std::holds_alternative<Header>(message) || std::holds_alternative<Pong>(message)) {
    playout_.clock() = stream_.clock();  // the playout is measured by these arrivals
  }
  if (const auto* header = std::get_if<Header>(&message)) {
    steps_ = quantizers_of(*header);
    if (playout_.begin(*header)) {
      held_.clear();
    }
  } else if (const auto* keyframe = std::get_if<Keyframe>(&message)) {
    const TimedFrame frame{0, keyframe->state};
    push(keyframe->sequence, keyframe->media_time, {&frame, 1});
  } else if (const auto* frames = std::get_if<Frames>(&message)) {
    push(frames->sequence, frames->media_time, frames->frames);
  }
}

void LivePlayer::push(std::uint64_t sequence, std::uint64_t media_time, std::span<const TimedFrame> frames) {
  const std::size_t before = held_.size();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double at = static_cast<double>(media_time) + frames[i].time;
    if (!held_.empty() && at <= held_.back().frame.media_time) {
      continue;  // sent again after a lost connection
    }
    const double begin = held_.empty() ? at : held_.back().frame.media_time;
    held_.push_back({{sequence + i, at, to_kernel_frame(frames[i].state, steps_)}, begin});
  }
  const std::size_t count = held_.size();
  if (count == before) {
    return;
  }
  held_[before].begin = playout_.arrived(held_[before].frame.media_time,
                                         held_[std::max(before, count < 2 ? 0 : count - 2)].frame.media_time,
                                         held_.back().frame.media_time, LiveStream::now());
  if (count > max_held_frames) {
    held_.erase(held_.begin(), held_.begin() + max_held_frames / 2);
  }
}

std::optional<DisplayedFrame> LivePlayer::show() {
  const double now = LiveStream::now();
  const double elapsed = now - shown_at_;
  shown_at_ = now;
  if (held_.empty()) {
    return std::nullopt;
  }
  playout_.advance(now, elapsed);
  const double playhead = playout_.playhead();
  while (held_.size() > 1 && held_[1].frame.media_time <= playhead) {
    held_.pop_front();
  }
  const Held& from = held_.front();
  const Held& to = held_.size() > 1 ? held_[1] : from;
  const double span = to.frame.media_time - to.begin;
  const double t = held_.size() > 1 && span > 0 ? std::clamp((playhead - to.begin) / span, 0.0, 1.0) : 0.0;
  return DisplayedFrame{from.frame, to.frame, static_cast<float>(t), playhead};
}

}  // namespace semblante::client

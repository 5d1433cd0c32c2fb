#include "server/streams/player.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace semblante::streams {
namespace {

double ms_between(Player::Clock::time_point from, Player::Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

/// A packet that is later than this is left out, as frames are.
constexpr std::chrono::milliseconds latest_sound{200};

}  // namespace

Player::Player(std::string id, std::shared_ptr<Stream> stream, std::uint64_t ticket,
               std::shared_ptr<const FrameSource> source, PlayOptions options, Clock::time_point begin)
    : id_(std::move(id)),
      stream_(std::move(stream)),
      ticket_(ticket),
      source_(std::move(source)),
      options_(options),
      begin_(begin),
      next_(begin),
      frames_(source_->frames_from(options.from)),
      sound_(source_->sound_from(options.from)),
      texts_(source_->texts_from(options.from)),
      rounds_ms_(-options.from) {}

double Player::end() const {
  // In this order: once it is complete, its duration does not change.
  const bool has_end = !options_.loop && source_->making().complete && source_->duration() > 0.0;
  return has_end ? std::max(0.0, source_->duration() - options_.from) : std::numeric_limits<double>::infinity();
}

Player::Clock::time_point Player::time_of(double played_ms) const {
  return begin_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double, std::milli>(played_ms));
}

void Player::play(Clock::time_point now) {
  if (finished_) return;
  play_texts(now);  // first: who reads them gets no frames of the speech
  play_sound(now);
  if (now < next_) return;
  if (frames_)
    play_frames(now);
  else
    play_at_rate(now);
  if (finished_) next_ = Clock::time_point::max();
}

Player::Clock::time_point Player::next_sound_time() const {
  const auto* sound = finished_ || !sound_ ? nullptr : sound_->current();
  if (sound == nullptr) return Clock::time_point::max();
  return time_of(static_cast<double>(sound->media_time) - options_.from);
}

void Player::play_sound(Clock::time_point now) {
  for (auto when = next_sound_time(); when <= now; when = next_sound_time()) {
    if (now - when <= latest_sound) stream_->play_sound(ticket_, when, sound_->current()->packet);
    sound_->advance();
  }
}

Player::Clock::time_point Player::next_text_time() const {
  const auto* text = finished_ || !texts_ ? nullptr : texts_->current();
  if (text == nullptr) return Clock::time_point::max();
  // One that stops what is being said has no lead.
  const auto lead = text->text.empty() ? Clock::duration::zero() : Clock::duration(text_lead);
  return std::max(begin_, time_of(static_cast<double>(text->media_time) - options_.from) - lead);
}

void Player::play_texts(Clock::time_point now) {
  while (next_text_time() <= now) {
    const auto& text = *texts_->current();
    stream_->publish_text(ticket_, time_of(static_cast<double>(text.media_time) - options_.from), text,
                          source_->texts_replace_frames());
    texts_->advance();
  }
}

bool Player::publish(double played_ms, const FaceFrame& face) {
  const TimedFrame frame{0, face};
  return ticket_ == 0 ? stream_->fill(time_of(played_ms), frame).ok()
                      : stream_->publish_playing(ticket_, time_of(played_ms), frame).ok();
}

void Player::play_at_rate(Clock::time_point now) {
  const double since = ms_between(begin_, now);
  frame_ = std::max(frame_, static_cast<std::uint64_t>(std::floor(since / frame_ms())));
  double played = static_cast<double>(frame_) * frame_ms();
  const double end_ms = end();
  const bool last = played >= end_ms || since >= end_ms;
  if (last) played = end_ms;
  double at = options_.from + played;
  if (options_.loop && source_->duration() > 0.0) at = std::fmod(at, source_->duration());
  const bool taken = publish(played, source_->frame_at(at, options_.from + played));
  ++frame_;
  finished_ = last || !taken;
  if (last) stream_->end_playing(ticket_, false);
  next_ = time_of(std::min(end_ms, static_cast<double>(frame_) * frame_ms()));
}

void Player::play_frames(Clock::time_point now) {
  for (std::size_t sent = 0; sent < most_at_once; ++sent) {
    auto time = frames_->time();
    if (!time && options_.loop) {
      rounds_ms_ += source_->duration();
      frames_ = source_->frames_from(0.0);
      time = frames_->time();
    }
    if (!time) {
      finished_ = true;
      stream_->end_playing(ticket_, false);
      return;
    }
    // A start between two frames first sends the face at that time.
    const bool leads_in = frame_ == 0 && *time > options_.from && options_.from > 0.0;
    const double played = leads_in ? 0.0 : rounds_ms_ + *time;
    next_ = time_of(played);
    if (next_ > now) return;
    if (!publish(played, leads_in ? source_->frame_at(options_.from, options_.from) : frames_->frame())) {
      finished_ = true;
      return;
    }
    ++frame_;
    if (!leads_in) frames_->advance();
  }
}

void Player::stop() {
  finished_ = true;
  next_ = Clock::time_point::max();
  stream_->end_playing(ticket_, true);
}

PlayStatus Player::status(Clock::time_point now) const {
  PlayStatus status;
  status.id = id_;
  status.kind = source_->kind();
  status.name = source_->name();
  status.duration = source_->duration();
  status.rate = options_.rate;
  status.loop = options_.loop;
  const double played = std::clamp(ms_between(begin_, now), 0.0, end());
  status.making = source_->making();
  status.position = options_.from + played;
  if (options_.loop && status.duration > 0.0) status.position = std::fmod(status.position, status.duration);
  return status;
}

}  // namespace semblante::streams

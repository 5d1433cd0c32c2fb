#include "clients/runtime/player.h"

#include <algorithm>
#include <cmath>

#include "clients/runtime/stream.h"
#include "protocol/cpp/kernel_values.h"

namespace semblante::runtime {
namespace {

/// A display's step that differs by more from the clock, ms, does not count: the program was blocked or hidden.
constexpr double strange_step = 50;
/// After a pause without display frames longer than this, ms, the machine may have slept.
constexpr double long_pause = 5000;

/// Places in Moment::frames.
constexpr std::size_t before_pair = 0, pair_from = 1, pair_to = 2, after_pair = 3;

/// The finest steps of a stream, for frames that come without one.
const QuantizerSteps& finest_steps() {
  static const QuantizerSteps steps = scaled_quantizers(quantizer_scales.back());
  return steps;
}

}  // namespace

Player::Player(const PlayerOptions& options) : options_(options), playout_(options.playout), steps_(finest_steps()) {}

Player::~Player() {
  if (stream_ != nullptr) stream_->remove(*this);
}

void Player::follow(Stream* stream) {
  if (stream == stream_) return;
  if (stream_ != nullptr) stream_->remove(*this);
  stream_ = stream;
  forget_moment();
  moment_.viseme_share.reset();  // it belongs to the stream
  playout_.use_clock(stream != nullptr ? &stream->clock() : nullptr);
  if (stream == nullptr) return;
  stream->add(*this);
  if (stream->header()) begin(*stream->header());
  // A face that rests sends nothing: what it looks like now was sent before.
  if (!stream->newest().frames.empty()) push(stream->newest(), stream->newest_at());
}

void Player::begin(const Header& header) {
  steps_ = quantizers_of(header);
  if (playout_.begin(header)) clear();
  forget_moment();
  moment_.viseme_share = header.viseme_share;
}

void Player::clear() {
  held_.clear();
  before_.reset();
  rested_at_ = unknown_time;
  playout_.clear();
  forget_moment();
  has_moment_ = false;
}

void Player::push(const Frames& frames, double now) {
  const std::size_t known = held_.size();
  for (std::size_t i = 0; i < frames.frames.size(); ++i) {
    const TimedFrame& frame = frames.frames[i];
    hold(static_cast<double>(frames.media_time) + frame.time, frames.sequence + i, frame.state);
  }
  arrived(known, now);
}

void Player::push(std::span<const semblante_timed_frame> frames, double now) {
  while (!frames.empty()) {
    const std::size_t known = held_.size();
    const auto some = frames.first(std::min(frames.size(), options_.max_frames));
    for (const auto& [time, frame] : some) hold(time, 0, quantized(frame, steps_));
    arrived(known, now);
    frames = frames.subspan(some.size());
  }
}

void Player::hold(double time, std::uint64_t sequence, const FaceFrame& state) {
  if (held_.empty()) {
    held_.push_back({time, time, sequence, state});
  } else if (time > held_.back().time) {  // else sent again after a lost connection
    held_.push_back({time, held_.back().time, sequence, state});
  }
}

void Player::arrived(std::size_t known, double now) {
  const std::size_t count = held_.size();
  if (count == known) return;
  const double before_last = held_[std::max(known, count < 2 ? 0 : count - 2)].time;
  held_[known].begin = playout_.arrived(held_[known].time, before_last, held_.back().time, now);
  // While nothing is shown only the newest frames matter.
  if (count > options_.max_frames) held_.pop_front(count - options_.max_frames / 2 - 1);
}

bool Player::advance(double now, double elapsed) {
  const double passed = std::isnan(last_advance_) ? 0 : now - last_advance_;
  last_advance_ = now;
  if (passed > long_pause && stream_ != nullptr) stream_->measure_clock(now);
  if (held_.empty()) return false;
  // The display's frame interval is more regular than the times at which it calls.
  const bool is_usable = elapsed >= 0 && std::abs(elapsed - passed) <= strange_step;
  playout_.advance(now, is_usable ? elapsed : passed);
  select();
  return true;
}

bool Player::move_to(double media_time) {
  last_advance_ = unknown_time;  // the time until the next advance() has been played already
  if (held_.empty()) return false;
  playout_.move_to(media_time);
  select();
  return true;
}

semblante_frame Player::in_units(const FaceFrame& state) const { return to_kernel_frame(to_values(state, steps_)); }

void Player::select() {
  const double playhead = playout_.playhead();
  while (held_.size() > 1 && held_[1].time <= playhead) {
    before_ = held_.front();
    held_.pop_front();
  }
  const Held& first = held_.front();
  const bool is_pair = held_.size() > 1;
  const Held& second = is_pair ? held_[1] : first;
  // After a rest the motion takes as long as between two messages, not the whole length of the rest.
  const double span = is_pair ? second.time - second.begin : 0;
  if (is_moment_forgotten_ || moment_.from_time != first.time || moment_.to_time != second.time) {
    is_moment_forgotten_ = false;
    moment_.frames[pair_from] = in_units(first.state);
    moment_.frames[pair_to] = is_pair ? in_units(second.state) : moment_.frames[pair_from];
    moment_.from_time = first.time;
    moment_.to_time = second.time;
    moment_.from_sequence = first.sequence;
    moment_.to_sequence = second.sequence;
    moment_.is_curve = false;
    if (options_.playout.eased) choose_curve(span);
  }
  moment_.t = span > 0 ? static_cast<float>(std::clamp((playhead - second.begin) / span, 0.0, 1.0)) : 0.0F;
  has_moment_ = true;
}

/// Chosen once for a pair: a frame that arrives later must not change a curve that is being shown. If no frame follows
/// yet, the curve ends without velocity, and the next one begins so.
void Player::choose_curve(double span) {
  const bool is_pair = held_.size() > 1;
  const double first = held_.front().time;
  const double time_before = rested_at_ == first || !before_ ? 0 : first - before_->time;
  const double time_after = held_.size() > 2 ? held_[2].time - held_[1].time : 0;
  // After a rest the span of the pair is shortened; its neighbours do not belong to the same motion.
  const bool is_whole = is_pair && span == held_[1].time - first;
  moment_.spans = {is_whole ? static_cast<float>(time_before) : 0.0F, static_cast<float>(span),
                   static_cast<float>(time_after)};
  moment_.is_curve = span > 0;
  if (moment_.spans[0] > 0) moment_.frames[before_pair] = in_units(before_->state);
  if (time_after > 0) moment_.frames[after_pair] = in_units(held_[2].state);
  rested_at_ = time_after > 0 || !is_pair ? unknown_time : held_[1].time;
}

}  // namespace semblante::runtime

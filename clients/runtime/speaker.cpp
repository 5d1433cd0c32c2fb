#include "clients/runtime/speaker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/performance/usual_times.h"

namespace semblante::runtime {
namespace {

constexpr std::uint8_t closed_lips = 1;  ///< the viseme of p, b, m
constexpr double fade = 40.0;            ///< half the time between two visemes, at most
constexpr double rest_ms = 160.0;        ///< until the mouth rests when the voice has ended
/// A full expression comes in 300 ms and goes in 500, as cues of performances do.
constexpr double full = 63.0, attack = full / 300.0, release = full / 500.0;
constexpr double blink_closing = usual_ramps[4].ramps.attack, least_pause = 1500.0, most_pause = 5500.0,
                 least_between_blinks = 900.0;
constexpr double least_speed = 0.5, most_speed = 2.0;

constexpr SpeechScore::Step silence{};

double length(const SpeechScore::Step& step) { return static_cast<double>(step.end) - step.begin; }

struct Window {
  double begin, end;
};

/// While a viseme gives way to the next one. p, b and m have the whole of their own time: the lips close before it.
Window between(const SpeechScore::Step& from, const SpeechScore::Step& to) {
  const double half = std::min({fade, length(from) / 2, length(to) / 2});
  const double at = to.begin;
  if (to.viseme == closed_lips) return {at - 2 * half, at};
  if (from.viseme == closed_lips) return {at, at + 2 * half};
  return {at - half, at + half};
}

}  // namespace

void Speaker::say(SpeechScore score, std::size_t first, double now) {
  advance(now);
  words_.clear();
  for (const Step& step : score.steps)
    if (step.begins_word) words_.push_back(step.begin);
  life_.begin(score);
  score_ = std::move(score);
  position_ = first < words_.size() ? words_[first] : 0.0;
  next_word_ = std::min(first + 1, words_.size());
  behind_ = waited_ = 0;
  is_told_ = false;
  word_at_ = position_;
  word_now_ = last_ = now;
  was_speaking_ = true;
}

void Speaker::reach(std::size_t word, double now) {
  if (!score_ || word >= words_.size() || word + 1 < next_word_) return;
  advance(now);
  const double at = words_[word];
  // The first word is no measure: voices tell it at once, or after what they need to begin.
  if (at > word_at_ && now > word_now_ && is_told_) {
    const double speed = std::clamp((at - word_at_) / (now - word_now_), least_speed, most_speed);
    speed_ += (speed - speed_) / 2;
  }
  is_told_ = true;
  word_at_ = at;
  word_now_ = now;
  next_word_ = word + 1;
  waited_ = 0;
  behind_ = std::max(0.0, at - position_);
}

void Speaker::end(double now) {
  advance(now);
  if (!score_) return;
  rest_ = mouth_at(position_);
  ended_ = now;
  score_.reset();
  life_.end();
}

void Speaker::advance(double now) {
  const double elapsed = std::max(0.0, now - last_);
  last_ = std::max(last_, now);
  if (score_) {
    const double more = std::min(behind_, elapsed * catch_up);
    behind_ -= more;
    double to = position_ + elapsed * speed_ + more;
    if (is_told_ && next_word_ < words_.size() && to > words_[next_word_]) {
      waited_ += elapsed;
      if (waited_ < patience)
        to = std::max(position_, words_[next_word_]);
      else
        ++next_word_, waited_ = 0;
    }
    const double before = std::exchange(position_, std::min(to, static_cast<double>(score_->duration())));
    // People blink between phrases; not again so soon.
    if (life_.phrase_ends(before, position_) && now - last_blink_ >= least_between_blinks) blink_ = now;
  }
  move_expressions(elapsed);
  life_.move(position_, elapsed);
}

void Speaker::move_expressions(double elapsed) {
  std::array<double, 7> wanted{};
  if (score_) {
    for (const auto& one : score_->expressions) {
      if (one.begin > position_) break;
      wanted.fill(0);
      if (one.expression > 0) wanted[one.expression] = one.intensity;
    }
  }
  for (std::size_t i = 1; i < levels_.size(); ++i)
    levels_[i] += std::clamp(wanted[i] - levels_[i], -release * elapsed, attack * elapsed);
}

Speaker::Mouth Speaker::mouth_at(double position) const {
  const auto& steps = score_->steps;
  const auto past = std::upper_bound(steps.begin(), steps.end(), position,
                                     [](double at, const Step& step) { return at < step.begin; });
  if (past == steps.begin()) return {};
  const auto now = past - 1;
  const Step before = now == steps.begin() ? Step{0, now->begin, 0, false} : *(now - 1);
  const Step after = past == steps.end() ? Step{now->end, now->end + 200, 0, false} : *past;
  if (position >= now->end) return {silence.viseme, silence.viseme, 1.0};
  if (const Window leaving = between(*now, after); position >= leaving.begin)
    return {now->viseme, after.viseme, 1.0 - (position - leaving.begin) / (leaving.end - leaving.begin)};
  if (const Window coming = between(before, *now); position < coming.end && now != steps.begin())
    return {before.viseme, now->viseme, 1.0 - (position - coming.begin) / (coming.end - coming.begin)};
  return {now->viseme, now->viseme, 1.0};
}

bool Speaker::show(double now, semblante_frame& frame) {
  advance(now);
  const bool shows = std::any_of(levels_.begin(), levels_.end(), [](double level) { return level >= 0.5; });
  const double rested = (now - ended_) / rest_ms;
  if (!score_ && (!was_speaking_ || rested >= 1.0) && !shows && life_.is_at_rest()) return false;

  Mouth mouth = rest_;
  if (score_) mouth = mouth_at(position_);
  // After the end the stronger viseme gives way to silence.
  if (!score_)
    mouth = {mouth.share >= 0.5 ? mouth.first : mouth.second, silence.viseme, std::clamp(1.0 - rested, 0.0, 1.0)};
  frame.viseme1 = mouth.first;
  frame.viseme2 = mouth.second;
  frame.viseme_blend = static_cast<std::uint8_t>(std::lround(std::clamp(mouth.share, 0.0, 1.0) * full));

  std::size_t first = 1, second = 2;
  for (std::size_t i = 2; i < levels_.size(); ++i) {
    if (levels_[i] > levels_[first])
      second = std::exchange(first, i);
    else if (i == second || levels_[i] > levels_[second])
      second = i;
  }
  const auto level = [&](std::size_t i) { return static_cast<std::uint8_t>(std::lround(levels_[i])); };
  frame.intensity1 = level(first);
  frame.expression1 = static_cast<std::uint8_t>(frame.intensity1 > 0 ? first : 0);
  frame.intensity2 = level(second);
  frame.expression2 = static_cast<std::uint8_t>(frame.intensity2 > 0 ? second : 0);
  life_.show(frame, 1.0 - std::max(levels_[first], levels_[second]) / full);
  blink(now, frame);
  return true;
}

void Speaker::blink(double now, semblante_frame& frame) {
  if (now >= blink_ + blink_ms) {
    // The first one, or one after a pause, comes some time from now.
    blink_ = std::max(blink_, now - blink_ms) + blink_ms + random_.between(least_pause, most_pause);
  }
  const double since = now - blink_;
  if (since < 0) return;
  last_blink_ = blink_;
  const double closure =
      since < blink_closing ? since / blink_closing : (blink_ms - since) / (blink_ms - blink_closing);
  for (const std::size_t fap : {19U, 20U, 21U, 22U}) {
    const auto closed = static_cast<float>(fap < 21 ? upper_lid_units : lower_lid_units);
    frame.fap[fap] += static_cast<float>(closure) * (closed - frame.fap[fap]);
  }
}

}  // namespace semblante::runtime

#include "clients/runtime/playout.h"

#include <algorithm>
#include <cmath>

#include "clients/runtime/times.h"

namespace semblante::runtime {
void Playout::use_clock(ClockEstimate* clock) {
  own_clock_.clear();
  clock_ = clock != nullptr ? clock : &own_clock_;
}

bool Playout::begin(const Header& header) {
  frame_interval_ = header.fps_hint > 0 ? 1000 / header.fps_hint : 0;
  message_interval_ = header.batch_interval > 0 ? static_cast<double>(header.batch_interval) : frame_interval_;
  history_until_ = static_cast<double>(header.media_time);
  const bool another = epoch_ && *epoch_ != header.epoch;
  if (another) {
    clear();
  }
  epoch_ = header.epoch;
  return another;
}

void Playout::clear() {
  playhead_ = newest_ = before_newest_ = transit_ = delay_ = wanted_delay_ = unknown_time;
  measured_interval_ = 0;
  seconds_.clear();
}

PlayoutStats Playout::stats() const {
  PlayoutStats stats = stats_;
  stats.delay = delay_;
  stats.wanted_delay = wanted_delay_;
  return stats;
}

double Playout::rest() const {
  return std::max(least_rest, 2.5 * (frame_interval_ > 0 ? frame_interval_ : measured_interval_));
}

void Playout::measure_interval(double gap) {
  if (gap < 1000) {
    measured_interval_ += measured_interval_ > 0 ? (gap - measured_interval_) / 10 : gap;
  }
}

double Playout::first_delay() const {
  if (options_.delay) {
    return *options_.delay;
  }
  const double intervals = (options_.eased ? 3 : 2) * message_interval_;
  return std::min(greatest_delay, std::max(least_delay, intervals) + clock_->uncertainty().value_or(0));
}

void Playout::measure_jitter(double transit) {
  if (!std::isnan(transit_)) {
    stats_.jitter += (std::abs(transit - transit_) - stats_.jitter) / 16;
  }
  transit_ = transit;
}

void Playout::count_lateness(double lateness, double now) {
  const auto second = static_cast<std::int64_t>(std::floor(now / 1000));
  while (!seconds_.empty() && seconds_.front().number <= second - seconds_kept) {
    seconds_.pop_front();
  }
  if (seconds_.empty() || seconds_.back().number != second) {
    seconds_.push_back({second, lateness});
  } else {
    seconds_.back().worst = std::max(seconds_.back().worst, lateness);
  }
  if (options_.delay) {
    return;
  }
  double worst = -std::numeric_limits<double>::infinity();
  double second_worst = worst;
  for (std::size_t i = 0; i < seconds_.size(); ++i) {
    const Second& each = seconds_[i];
    second_worst = std::max(second_worst, std::min(worst, each.worst));
    worst = std::max(worst, each.worst);
  }
  const double counts = seconds_.size() < seconds_for_second_worst ? worst : second_worst;
  wanted_delay_ = std::clamp(counts + margin, least_delay, greatest_delay);
  if (seconds_.size() < 2) {
    wanted_delay_ = std::max(wanted_delay_, first_delay());
  }
}

double Playout::arrived(double first, double before_last, double last, double now) {
  clock_->heard(now, last);
  const double clock = *clock_->at(now);
  const double before = newest_;
  const double base = options_.eased ? before_newest_ : before;
  newest_ = last;
  before_newest_ = before_last < last ? before_last : before;
  measure_jitter(clock - last);
  const double since = std::isnan(arrived_at_) ? 0 : now - arrived_at_;
  arrived_at_ = now;
  if (std::isnan(before)) {
    before_newest_ = before_last;
    delay_ = wanted_delay_ = first_delay();
    playhead_ = std::min(clock - delay_, last);
    return first;
  }
  if (is_moved_) move_delay(std::max(0.0, since));
  const bool rested = first - before > rest();
  measure_interval(first - before);
  const double wanted = clock - delay_;
  // The playhead is held at the newest frame that had arrived, and should be farther.
  const bool held = playhead_ >= before && wanted > playhead_;
  if (before >= history_until_) {
    count_lateness(clock - (rested ? first - motion_after_rest : base), now);
  }
  if (rested) {
    // The face did not move in between: continuing at the right time is not a visible jump.
    if (held) {
      playhead_ = std::max(playhead_, std::min(wanted, first - motion_after_rest / 2));
    }
    return std::max({before, first - motion_after_rest, held ? playhead_ : before});
  }
  if (!held) {
    return before;
  }
  ++stats_.starved;
  stats_.starved_time += wanted - playhead_;
  if (!options_.delay) {
    // A small lag is caught up slowly.
    const double behind = clock - playhead_;
    delay_ = behind - wanted_delay_ > snap_threshold ? wanted_delay_ : behind;
  }
  return before;
}

double Playout::move_delay(double elapsed) {
  const double step = std::clamp(wanted_delay_ - delay_, -delay_rate * elapsed, delay_rate * elapsed);
  delay_ += step;
  return step;
}

void Playout::advance(double now, double elapsed) {
  is_moved_ = false;
  if (std::isnan(playhead_)) {
    return;
  }
  const std::optional<double> clock = clock_->at(now);
  if (!clock) {
    return;  // that of a stream followed since, which has sent nothing yet
  }
  elapsed = std::max(0.0, elapsed);
  const double step = move_delay(elapsed);
  const double wanted = *clock - delay_;
  const double error = wanted - (playhead_ + elapsed - step);
  double next = playhead_;
  if (error > snap_threshold) {
    next = wanted;
  } else if (error >= -snap_threshold) {
    const double most = max_speed_change * elapsed;
    next += elapsed + std::clamp(error * elapsed / correction_time - step, -most, most);
  }
  next = std::max(playhead_, std::min(next, newest_));
  if (next - playhead_ > elapsed + snap_threshold / 2) {
    ++stats_.snaps;
  }
  playhead_ = next;
  stats_.error = playhead_ - wanted;
}

void Playout::move_to(double media_time) {
  if (std::isnan(newest_)) {
    return;
  }
  is_moved_ = true;
  const double back = playhead_ - media_time;
  if (!(back > 0 && back <= snap_threshold)) {
    playhead_ = std::min(media_time, newest_);
  }
}

}  // namespace semblante::runtime

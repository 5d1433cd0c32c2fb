#include "clients/runtime/clock_estimate.h"

#include <algorithm>
#include <limits>

namespace semblante::runtime {

ClockEstimate::Bounds ClockEstimate::bounds_at(double local) const {
  Bounds all{local, -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < answers_.size(); ++i) {
    const Bounds& each = answers_[i];
    const double age = local - each.at;
    all.low = std::max(all.low, each.low + (drift_ - drift_slack) * age);
    all.high = std::min(all.high, each.high + (drift_ + drift_slack) * age);
  }
  return all;
}

void ClockEstimate::answered(double sent, double received, double media_time) {
  if (!(received >= sent)) {
    return;
  }
  // The answer has whole ms, truncated.
  const Bounds bounds{received, media_time - received, media_time + 1 - sent};
  if (!answers_.empty()) {
    const Bounds before = bounds_at(received);
    if (bounds.low > before.high || bounds.high < before.low) {
      answers_.clear();
      past_.clear();
      drift_ = 0;
      ++steps_;
    }
  }
  while (!answers_.empty() && (received - answers_.front().at > window || answers_.size() >= most_answers)) {
    answers_.pop_front();
  }
  answers_.push_back(bounds);
  const Bounds all = bounds_at(received);
  now_ = {received, (all.low + all.high) / 2};
  half_width_ = (all.high - all.low) / 2;
  round_trip_ = received - sent;
  known_ = answered_ = true;
  measure_drift();
}

void ClockEstimate::measure_drift() {
  while (!past_.empty() && now_.at - past_.front().at > drift_span) {
    past_.pop_front();
  }
  if (past_.empty() || now_.at - past_.back().at >= drift_step) {
    past_.push_back(now_);
  }
  const double span = now_.at - past_.front().at;
  if (span >= drift_least_span) {
    drift_ = std::clamp((now_.offset - past_.front().offset) / span, -greatest_drift, greatest_drift);
  }
}

void ClockEstimate::heard(double received, double media_time) {
  const double offset = media_time - received;
  if (answered_) {
    if (offset <= now_.offset + half_width_ + farthest_ahead) {
      return;
    }
    // No server sends this: the local clock was suspended. Until the next answer only frames give an estimate.
    const std::size_t steps = steps_ + 1;
    clear();
    steps_ = steps;
  }
  if (!known_ || offset >= now_.offset || received - heard_at_ > heard_window) {
    now_ = {received, offset};
    heard_at_ = received;
    known_ = true;
  }
}

void ClockEstimate::clear() {
  answers_.clear();
  past_.clear();
  now_ = {};
  known_ = answered_ = false;
  half_width_ = drift_ = heard_at_ = 0;
  round_trip_.reset();
  steps_ = 0;
}

std::optional<double> ClockEstimate::at(double local) const {
  if (!known_) {
    return std::nullopt;
  }
  return local + now_.offset + drift_ * (local - now_.at);
}

std::optional<double> ClockEstimate::uncertainty() const {
  return answered_ ? std::optional(half_width_) : std::nullopt;
}

}  // namespace semblante::runtime

#include "protocol/clips/clip_tracks.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

namespace semblante {

VectorTrack::VectorTrack(double tolerance) : slack_(tolerance / std::sqrt(3.0)) {}

void VectorTrack::keep_last() {
  times_.push_back(last_time_);
  values_.push_back(last_);
  low_ = glm::dvec3(-std::numeric_limits<double>::infinity());
  high_ = glm::dvec3(std::numeric_limits<double>::infinity());
}

void VectorTrack::push(float time, const glm::vec3& value) {
  if (times_.empty()) {
    last_time_ = time;
    last_ = value;
    keep_last();
    return;
  }
  assert(time > last_time_);
  glm::dvec3 from = glm::dvec3(values_.back());
  double span = static_cast<double>(time) - times_.back();
  const glm::dvec3 slope = (glm::dvec3(value) - from) / span;
  for (int c = 0; c < 3; ++c) {
    if (slope[c] >= low_[c] && slope[c] <= high_[c]) continue;
    keep_last();
    from = glm::dvec3(last_);
    span = static_cast<double>(time) - last_time_;
    break;
  }
  const glm::dvec3 way = glm::dvec3(value) - from;
  low_ = glm::max(low_, (way - slack_) / span);
  high_ = glm::min(high_, (way + slack_) / span);
  last_time_ = time;
  last_ = value;
}

void VectorTrack::finish() {
  if (times_.empty()) return;
  const bool still = values_.size() == 1 && values_.front() == last_;
  if (!still && last_time_ > times_.back()) keep_last();
}

bool TurnTrack::leads_to(const Sample& end) const {
  const glm::dquat a(values_.back());
  const glm::dquat b(end.value);
  const double span = static_cast<double>(end.time) - times_.back();
  return std::all_of(since_.begin(), since_.end(), [&](const Sample& between) {
    const glm::dquat on_line = glm::slerp(a, b, (static_cast<double>(between.time) - times_.back()) / span);
    const glm::dquat exact(between.value);
    const double side = glm::dot(on_line, exact) < 0.0 ? -1.0 : 1.0;
    return 2.0 * glm::length(on_line + exact * -side) <= tolerance_;  // a chord of unit quaternions is half the angle
  });
}

void TurnTrack::keep(const Sample& sample) {
  times_.push_back(sample.time);
  // q and -q are the same rotation: uses the nearer one, so that readers without a test also take the shorter arc.
  const bool far = !values_.empty() && glm::dot(values_.back(), sample.value) < 0.0F;
  values_.push_back(far ? -sample.value : sample.value);
  since_.clear();
}

void TurnTrack::push(float time, const glm::quat& value) {
  const Sample sample{time, value};
  if (times_.empty()) {
    keep(sample);
    return;
  }
  if (since_.size() >= max_span || !leads_to(sample)) keep(Sample(since_.back()));
  since_.push_back(sample);
}

void TurnTrack::finish() {
  if (!since_.empty()) keep(Sample(since_.back()));
}

}  // namespace semblante

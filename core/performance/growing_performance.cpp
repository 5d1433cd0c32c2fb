#include "core/performance/growing_performance.h"

#include <algorithm>
#include <cmath>

#include "core/performance/usual_times.h"

namespace semblante {
namespace {

/// A cue may be held after its end, until the next one has arrived (track.h); no cue of a face takes longer to arrive.
constexpr double longest_hold_ms = 5'000.0;

double end_of(const Cue& cue) {
  if (cue.duration) return cue.time + *cue.duration;
  return cue.time + std::max(cue.keys.empty() ? 0.0 : cue.keys.back().time, blink_ms);
}

/// The time from which the face depends on the next cue, if that begins before the end of this one. For a look it is
/// the cue's beginning: the times at which the head follows are not in the cue.
double release_of(const Cue& cue) {
  const bool is_known = cue.duration && cue.release && !std::holds_alternative<LookTarget>(cue.target);
  return is_known ? cue.time + *cue.duration - *cue.release : cue.time;
}

}  // namespace

Result<double> GrowingPerformance::add(const PerformanceScript& part, double lead, double length, double shown) {
  double begin = end_;
  double changes = 0.0;  // from here on the face is another
  if (!stretches_.empty()) {
    const double reach = begin - lead + (part.cues.empty() ? lead : part.cues.front().time);
    changes = reach;
    double over = shown;
    for (const Cue& cue : newest_.cues) {
      over = std::max(over, end_of(cue));
      if (end_of(cue) >= reach) changes = std::min(changes, release_of(cue));
    }
    if (changes <= shown) {
      const double steps = std::floor((over - reach) / late_step_ms) + 1.0;
      begin += std::max(0.0, steps) * late_step_ms;
      changes = std::max(reach + begin - end_, shown);
    }
  }
  PerformanceScript script;
  script.name = stretches_.empty() ? part.name : newest_.name;
  script.idle = stretches_.empty() ? part.idle : newest_.idle;
  script.duration = max_performance_ms;
  for (const Cue& cue : newest_.cues)
    if (end_of(cue) + longest_hold_ms > changes) script.cues.push_back(cue);
  for (Cue cue : part.cues) {
    cue.time = std::max(0.0, cue.time + begin - lead);
    script.cues.push_back(std::move(cue));
  }
  std::stable_sort(script.cues.begin(), script.cues.end(), [](const Cue& a, const Cue& b) { return a.time < b.time; });
  auto face = Performance::compile(script);
  if (!face) return face.error();
  stretches_.push_back({changes, *std::move(face)});
  newest_ = std::move(script);
  end_ = begin + length;
  return begin;
}

semblante_frame GrowingPerformance::frame_at(double ms, double idle_ms) const {
  const auto after = std::upper_bound(stretches_.begin(), stretches_.end(), ms,
                                      [](double time, const Stretch& stretch) { return time < stretch.begin; });
  return after == stretches_.begin() ? semblante_frame{} : (after - 1)->face.frame_at(ms, idle_ms);
}

std::size_t GrowingPerformance::bytes() const {
  std::size_t sum = sizeof(*this);
  for (const Stretch& stretch : stretches_) sum += stretch.face.bytes();
  return sum;
}

}  // namespace semblante

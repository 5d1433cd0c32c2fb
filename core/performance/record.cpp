#include "core/performance/record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/tables/mpeg4.h"
#include "core/types/decimal.h"

namespace semblante {
namespace {

constexpr double alone_ms = 40.0;  ///< how long a recording of one frame is

/// A subset of the points, including the first and the last, whose linear interpolation is within the tolerance of all
/// points: from each key greedily to the farthest point reachable through the tolerance intervals in between.
std::vector<CueKey> thinned(const std::vector<CueKey>& points, double tolerance) {
  std::vector<CueKey> keys = {points.front()};
  std::size_t from = 0;
  while (from + 1 < points.size()) {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    std::size_t seen = from + 1;
    for (std::size_t i = from + 1; i < points.size(); ++i) {
      const double run = points[i].time - points[from].time;
      const double rise = points[i].value - points[from].value;
      if (rise / run < lowest || rise / run > highest) break;
      seen = i;
      lowest = std::max(lowest, (rise - tolerance) / run);
      highest = std::min(highest, (rise + tolerance) / run);
    }
    keys.push_back(points[seen]);
    from = seen;
  }
  return keys;
}

class CueBuilder {
 public:
  CueBuilder(std::vector<RecordedFrame> frames, double tolerance) : frames_(std::move(frames)), tolerance_(tolerance) {
    const double begin = frames_.front().time;
    for (RecordedFrame& frame : frames_) frame.time -= begin;
    const double last = frames_.back().time;
    end_ = last + (frames_.size() > 1 ? last / static_cast<double>(frames_.size() - 1) : alone_ms);
  }

  Result<PerformanceScript> script() {
    add_visemes();
    for (std::size_t e = 1; e < SEMBLANTE_EXPRESSION_COUNT; ++e) {
      add_runs(ExpressionTarget{static_cast<std::uint8_t>(e)}, tolerance_ / SEMBLANTE_BLEND_MAX,
               [&](const semblante_frame& f) { return intensity(f, e) / SEMBLANTE_BLEND_MAX; });
    }
    for (std::size_t n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) {
      add_runs(FapTarget{static_cast<std::uint8_t>(n)}, tolerance_ * mpeg4::fap(n).quantizer_step,
               [&](const semblante_frame& f) { return static_cast<double>(f.fap[n]); });
    }
    if (cues_.size() > max_performance_cues)
      return Error{ErrorCode::too_large, "",
                   "it takes more than " + natural_text(max_performance_cues) + " cues: record less, or more coarsely"};
    if (keys_ > max_performance_keys)
      return Error{ErrorCode::too_large, "",
                   "it takes more than " + natural_text(max_performance_keys) + " keys: record less, or more coarsely"};
    std::stable_sort(cues_.begin(), cues_.end(), [](const Cue& a, const Cue& b) { return a.time < b.time; });
    PerformanceScript script;
    script.duration = end_;
    script.cues = std::move(cues_);
    return script;
  }

 private:
  static double intensity(const semblante_frame& frame, std::size_t expression) {
    double sum = 0.0;
    if (frame.expression1 == expression) sum += frame.intensity1;
    if (frame.expression2 == expression) sum += frame.intensity2;
    return std::min<double>(sum, SEMBLANTE_BLEND_MAX);
  }

  [[nodiscard]] double time_after(std::size_t frame) const {
    return frame + 1 < frames_.size() ? frames_[frame + 1].time : end_;
  }

  void add(CueTarget target, const std::vector<CueKey>& points, double end, double tolerance) {
    Cue cue;
    cue.time = points.front().time;
    cue.duration = end - cue.time;
    cue.target = target;
    cue.easing.kind = EasingKind::linear;
    cue.keys = thinned(points, tolerance);
    for (CueKey& key : cue.keys) key.time -= cue.time;
    keys_ += cue.keys.size();
    cues_.push_back(std::move(cue));
  }

  /// A cue for each run of nonzero values, from the frame at rest before the run to the one after it.
  template <class Value>
  void add_runs(CueTarget target, double tolerance, Value value) {
    std::vector<CueKey> points;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const double now = value(frames_[i].face);
      if (now != 0.0) {
        if (points.empty() && i > 0) points.push_back({frames_[i - 1].time, 0.0});
        points.push_back({frames_[i].time, now});
      } else if (!points.empty()) {
        points.push_back({frames_[i].time, 0.0});
        add(target, points, frames_[i].time, tolerance);
        points.clear();
      }
    }
    if (!points.empty()) add(target, points, end_, tolerance);
  }

  void add_visemes() {
    std::vector<CueKey> points;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const semblante_frame& face = frames_[i].face;
      points.push_back({frames_[i].time, static_cast<double>(face.viseme_blend) / SEMBLANTE_BLEND_MAX});
      const bool goes_on = i + 1 < frames_.size() && frames_[i + 1].face.viseme1 == face.viseme1 &&
                           frames_[i + 1].face.viseme2 == face.viseme2;
      if (goes_on) continue;
      if (face.viseme1 != 0 || face.viseme2 != 0)
        add(VisemeTarget{face.viseme1, face.viseme2}, points, time_after(i), tolerance_ / SEMBLANTE_BLEND_MAX);
      points.clear();
    }
  }

  std::vector<RecordedFrame> frames_;  ///< each at a time of its own, the first at 0
  double tolerance_;
  double end_ = 0.0;
  std::vector<Cue> cues_;
  std::size_t keys_ = 0;
};

}  // namespace

Result<PerformanceScript> record_performance(std::span<const RecordedFrame> frames, const RecordingOptions& options) {
  if (frames.empty()) return Error{ErrorCode::empty, "", "there is no frame in the recording"};
  if (!std::isfinite(options.tolerance) || options.tolerance < 0.0)
    return Error{ErrorCode::out_of_range, "tolerance", "must be 0 or more quantizer steps"};
  std::vector<RecordedFrame> apart;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const RecordedFrame& frame = frames[i];
    const auto refuse = [&](std::string message) {
      return Error{ErrorCode::out_of_range, "/frames/" + natural_text(i), std::move(message)};
    };
    if (!std::isfinite(frame.time) || (i > 0 && frame.time < frames[i - 1].time))
      return refuse("times must not decrease");
    if (!std::all_of(frame.face.fap + 3, std::end(frame.face.fap), [](float value) { return std::isfinite(value); }))
      return refuse("a value is not finite");
    if (frame.face.viseme1 >= SEMBLANTE_VISEME_COUNT || frame.face.viseme2 >= SEMBLANTE_VISEME_COUNT ||
        frame.face.viseme_blend > SEMBLANTE_BLEND_MAX)
      return refuse("there is no such viseme or blend");
    if (!apart.empty() && apart.back().time == frame.time)
      apart.back() = frame;
    else
      apart.push_back(frame);
  }
  return CueBuilder(std::move(apart), options.tolerance).script();
}

}  // namespace semblante

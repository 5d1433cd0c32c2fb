#include "server/streams/fap_source.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "protocol/cpp/fap_file_frames.h"

namespace semblante::streams {
namespace {

class FapSource : public FrameSource {
 public:
  FapSource(std::span<const TimedValues> frames, double rate, std::string name, const QuantizerSteps& steps)
      : name_(std::move(name)), steps_(steps), duration_(frames.back().time + 1000.0 / rate) {
    frames_.reserve(frames.size());
    for (const auto& frame : frames) frames_.push_back({frame.time, to_frame(frame.state, steps_)});
  }
  [[nodiscard]] std::string_view kind() const override { return "fap"; }
  [[nodiscard]] std::string name() const override { return name_; }
  /// Includes the last frame, so that a loop shows it as long as the others.
  [[nodiscard]] double duration() const override { return duration_; }
  [[nodiscard]] FaceFrame frame_at(double ms, double /*played_ms*/) const override {
    // Times of the file are rounded to milliseconds; times at the file's own rate must give exactly its frames.
    const auto after = std::upper_bound(frames_.begin(), frames_.end(), ms + 0.5,
                                        [](double time, const TimedFrame& frame) { return time < frame.time; });
    if (after == frames_.begin()) return frames_.front().state;
    const TimedFrame& from = *(after - 1);
    if (after == frames_.end() || ms - from.time <= 0.5) return from.state;
    const double t = (ms - from.time) / static_cast<double>(after->time - from.time);
    return to_frame(between(to_values(from.state, steps_), to_values(after->state, steps_), t), steps_);
  }

  [[nodiscard]] std::size_t bytes() const override { return frames_.capacity() * sizeof(TimedFrame); }

 private:
  const std::string name_;
  const QuantizerSteps steps_;
  const double duration_;
  std::vector<TimedFrame> frames_;  ///< quantized, which takes a quarter of the memory
};

}  // namespace

std::shared_ptr<const FrameSource> make_fap_source(std::span<const TimedValues> frames, double rate, std::string name,
                                                   const QuantizerSteps& steps) {
  assert(!frames.empty() && rate > 0);
  return std::make_shared<FapSource>(frames, rate, std::move(name), steps);
}

}  // namespace semblante::streams

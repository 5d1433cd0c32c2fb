#include "server/streams/performance_source.h"

#include <cassert>
#include <utility>

#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/performance_document.h"
#include "server/streams/demo_document.h"

namespace semblante::streams {
namespace {

class PerformanceSource : public FrameSource {
 public:
  PerformanceSource(Performance performance, const QuantizerSteps& steps)
      : performance_(std::move(performance)), steps_(steps) {}
  [[nodiscard]] std::string_view kind() const override { return "performance"; }
  [[nodiscard]] std::string name() const override { return performance_.name(); }
  [[nodiscard]] double duration() const override { return performance_.duration(); }
  [[nodiscard]] FaceFrame frame_at(double ms, double played_ms) const override {
    return quantized(performance_.frame_at(ms, played_ms), steps_);
  }
  [[nodiscard]] std::size_t bytes() const override { return performance_.bytes(); }

 private:
  const Performance performance_;
  const QuantizerSteps steps_;
};

}  // namespace

std::shared_ptr<const FrameSource> make_performance_source(Performance performance, const QuantizerSteps& steps) {
  return std::make_shared<PerformanceSource>(std::move(performance), steps);
}

std::shared_ptr<const FrameSource> demo_source() {
  static const std::shared_ptr<const FrameSource> source = [] {
    auto script = read_performance(demo_document());
    assert(script);
    auto performance = Performance::compile(*script);
    assert(performance);
    return make_performance_source(std::move(*performance));
  }();
  return source;
}

}  // namespace semblante::streams

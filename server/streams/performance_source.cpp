#include "server/streams/performance_source.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/performance_document.h"
#include "server/streams/demo_document.h"

namespace semblante::streams {
namespace {

class Sound : public SoundCursor {
 public:
  explicit Sound(std::span<const SoundPacket> packets) : packets_(packets) {}
  [[nodiscard]] const SoundPacket* packet() const override { return packets_.empty() ? nullptr : packets_.data(); }
  void advance() override { packets_ = packets_.subspan(1); }

 private:
  std::span<const SoundPacket> packets_;
};

class PerformanceSource : public FrameSource {
 public:
  PerformanceSource(Performance performance, const QuantizerSteps& steps, std::vector<SoundPacket> sound)
      : performance_(std::move(performance)), steps_(steps), sound_(std::move(sound)) {}
  [[nodiscard]] std::string_view kind() const override { return "performance"; }
  [[nodiscard]] std::string name() const override { return performance_.name(); }
  [[nodiscard]] double duration() const override { return performance_.duration(); }
  [[nodiscard]] FaceFrame frame_at(double ms, double played_ms) const override {
    return quantized(performance_.frame_at(ms, played_ms), steps_);
  }

  [[nodiscard]] std::unique_ptr<SoundCursor> sound_from(double ms) const override { return packets_from(sound_, ms); }
  [[nodiscard]] std::size_t bytes() const override {
    std::size_t bytes = performance_.bytes();
    for (const auto& packet : sound_) bytes += sizeof(packet) + packet.packet.capacity();
    return bytes;
  }

 private:
  const Performance performance_;
  const QuantizerSteps steps_;
  const std::vector<SoundPacket> sound_;
};

}  // namespace

std::shared_ptr<const FrameSource> make_performance_source(Performance performance, const QuantizerSteps& steps,
                                                           std::vector<SoundPacket> sound) {
  return std::make_shared<PerformanceSource>(std::move(performance), steps, std::move(sound));
}

std::unique_ptr<SoundCursor> packets_from(std::span<const SoundPacket> packets, double ms) {
  const auto first = std::find_if(packets.begin(), packets.end(),
                                  [ms](const SoundPacket& one) { return static_cast<double>(one.media_time) >= ms; });
  return std::make_unique<Sound>(packets.subspan(static_cast<std::size_t>(first - packets.begin())));
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

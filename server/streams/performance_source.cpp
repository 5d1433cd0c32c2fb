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

class Texts : public TextCursor {
 public:
  explicit Texts(std::span<const SpeechText> texts) : texts_(texts) {}
  [[nodiscard]] const SpeechText* text() const override { return texts_.empty() ? nullptr : texts_.data(); }
  void advance() override { texts_ = texts_.subspan(1); }

 private:
  std::span<const SpeechText> texts_;
};

class PerformanceSource : public FrameSource {
 public:
  PerformanceSource(Performance performance, const QuantizerSteps& steps, std::vector<SoundPacket> sound,
                    std::vector<SpeechText> texts)
      : performance_(std::move(performance)), steps_(steps), sound_(std::move(sound)), texts_(std::move(texts)) {}
  [[nodiscard]] std::string_view kind() const override { return "performance"; }
  [[nodiscard]] std::string name() const override { return performance_.name(); }
  [[nodiscard]] double duration() const override { return performance_.duration(); }
  [[nodiscard]] FaceFrame frame_at(double ms, double played_ms) const override {
    return quantized(performance_.frame_at(ms, played_ms), steps_);
  }

  [[nodiscard]] std::unique_ptr<SoundCursor> sound_from(double ms) const override { return packets_from(sound_, ms); }
  [[nodiscard]] std::unique_ptr<TextCursor> texts_from(double ms) const override { return texts_after(texts_, ms); }
  [[nodiscard]] std::size_t bytes() const override {
    std::size_t bytes = performance_.bytes();
    for (const auto& packet : sound_) bytes += sizeof(packet) + packet.packet.capacity();
    for (const auto& text : texts_) bytes += sizeof(text) + text.text.capacity() + text.score.capacity();
    return bytes;
  }

 private:
  const Performance performance_;
  const QuantizerSteps steps_;
  const std::vector<SoundPacket> sound_;
  const std::vector<SpeechText> texts_;
};

}  // namespace

std::shared_ptr<const FrameSource> make_performance_source(Performance performance, const QuantizerSteps& steps,
                                                           std::vector<SoundPacket> sound,
                                                           std::vector<SpeechText> texts) {
  return std::make_shared<PerformanceSource>(std::move(performance), steps, std::move(sound), std::move(texts));
}

std::unique_ptr<SoundCursor> packets_from(std::span<const SoundPacket> packets, double ms) {
  const auto first = std::find_if(packets.begin(), packets.end(),
                                  [ms](const SoundPacket& one) { return static_cast<double>(one.media_time) >= ms; });
  return std::make_unique<Sound>(packets.subspan(static_cast<std::size_t>(first - packets.begin())));
}

std::unique_ptr<TextCursor> texts_after(std::span<const SpeechText> texts, double ms) {
  const auto first = std::find_if(texts.begin(), texts.end(),
                                  [ms](const SpeechText& one) { return static_cast<double>(one.media_time) >= ms; });
  return std::make_unique<Texts>(texts.subspan(static_cast<std::size_t>(first - texts.begin())));
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

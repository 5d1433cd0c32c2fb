#include "server/recordings/recording_source.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "protocol/cpp/face_values.h"

namespace semblante::recordings {
namespace {

using SharedReader = std::shared_ptr<const RecordingReader>;

/// Converts the levels of a recording to those of a stream; does nothing if their steps are equal.
struct Requantizer {
  QuantizerSteps from, to;
  [[nodiscard]] FaceFrame operator()(const FaceFrame& frame) const {
    return from == to ? frame : to_frame(to_values(frame, from), to);
  }
};

class Cursor : public streams::FrameCursor {
 public:
  Cursor(SharedReader reader, std::uint32_t ms, const Requantizer& requantize)
      : cursor_(std::move(reader), ms), requantize_(requantize) {}
  [[nodiscard]] std::optional<double> time() const override {
    return cursor_.frame() != nullptr ? std::optional<double>(cursor_.time()) : std::nullopt;
  }
  [[nodiscard]] FaceFrame frame() const override { return requantize_(cursor_.frame()->state); }
  void advance() override { cursor_.advance(); }

 private:
  RecordingCursor cursor_;
  const Requantizer& requantize_;
};

class Sound : public streams::SoundCursor {
 public:
  Sound(SharedReader reader, std::uint32_t ms) : cursor_(std::move(reader), ms) {}
  [[nodiscard]] const SoundPacket* current() const override { return cursor_.packet(); }
  void advance() override { cursor_.advance(); }

 private:
  RecordingSoundCursor cursor_;
};

class Texts : public streams::TextCursor {
 public:
  Texts(const std::vector<SpeechText>& texts, double ms) : texts_(texts) {
    while (next_ < texts_.size() && static_cast<double>(texts_[next_].media_time) < ms) ++next_;
  }
  [[nodiscard]] const SpeechText* current() const override { return next_ < texts_.size() ? &texts_[next_] : nullptr; }
  void advance() override { ++next_; }

 private:
  const std::vector<SpeechText>& texts_;
  std::size_t next_ = 0;
};

/// Of a time in a recording: whole ms, not before it.
std::uint32_t from_ms(double ms) { return static_cast<std::uint32_t>(std::ceil(std::max(ms, 0.0))); }

class RecordingSource : public streams::FrameSource {
 public:
  RecordingSource(SharedReader reader, std::vector<SpeechText> texts, std::string name, const Requantizer& requantize)
      : reader_(std::move(reader)), texts_(std::move(texts)), name_(std::move(name)), requantize_(requantize) {}
  [[nodiscard]] std::string_view kind() const override { return "recording"; }
  [[nodiscard]] std::string name() const override { return name_; }
  /// Includes the last frame, which lasts the mean interval.
  [[nodiscard]] double duration() const override {
    return reader_->duration() + std::max(1.0, std::round(reader_->mean_interval()));
  }
  [[nodiscard]] FaceFrame frame_at(double ms, double /*played_ms*/) const override {
    const auto frame = reader_->at(static_cast<std::uint32_t>(std::max(ms, 0.0)));
    return frame && *frame ? requantize_((*frame)->state) : FaceFrame{};
  }
  [[nodiscard]] std::unique_ptr<streams::FrameCursor> frames_from(double ms) const override {
    return std::make_unique<Cursor>(reader_, from_ms(ms), requantize_);
  }
  [[nodiscard]] std::unique_ptr<streams::SoundCursor> sound_from(double ms) const override {
    return std::make_unique<Sound>(reader_, from_ms(ms));
  }
  [[nodiscard]] std::unique_ptr<streams::TextCursor> texts_from(double ms) const override {
    return std::make_unique<Texts>(texts_, ms);
  }
  /// Not all of what it shows need be speech.
  [[nodiscard]] bool texts_replace_frames() const override { return false; }
  [[nodiscard]] std::size_t bytes() const override {
    std::size_t texts = 0;
    for (const auto& text : texts_) texts += sizeof(text) + text.text.capacity() + text.score.capacity();
    return reader_->whole_bytes() + texts + max_chunk_frames * sizeof(RecordingFrame);
  }

 private:
  const SharedReader reader_;
  const std::vector<SpeechText> texts_;
  const std::string name_;
  const Requantizer requantize_;
};

}  // namespace

Result<std::shared_ptr<const streams::FrameSource>> make_recording_source(
    const std::shared_ptr<const ByteSource>& bytes, std::string name, const QuantizerSteps& steps) {
  // The chunks, and not what follows the last one: a damaged file may have any size.
  const auto found = RecordingReader::open(bytes, Check::heads);
  if (!found) return found.error();
  std::vector<std::uint8_t> copy(found->whole_bytes());
  if (!bytes->read(0, copy)) return Error{ErrorCode::io, "", "the recording cannot be read"};
  auto reader = RecordingReader::open(bytes_in_memory(std::move(copy)), Check::everything);
  if (!reader) return reader.error();
  if (reader->frames() == 0) return Error{ErrorCode::empty, "", "the recording has no frame"};
  auto texts = reader->texts();
  if (!texts) return texts.error();
  const Requantizer requantize{quantizers_of(reader->header()), steps};
  return std::shared_ptr<const streams::FrameSource>(std::make_shared<RecordingSource>(
      std::make_shared<const RecordingReader>(std::move(*reader)), *std::move(texts), std::move(name), requantize));
}

}  // namespace semblante::recordings

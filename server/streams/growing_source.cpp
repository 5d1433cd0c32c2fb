#include "server/streams/growing_source.h"

#include <algorithm>
#include <utility>

#include "protocol/cpp/kernel_values.h"

namespace semblante::streams {
namespace {

/// From a part's place to its first packet: coding takes 10 ms, and the player looks 25 times a second.
constexpr double ahead_ms = 120.0;

}  // namespace

/// Over messages that stay where they are when others come, guarded by the source's mutex.
template <class Message>
class GrowingSource::Cursor : public MessageCursor<Message> {
 public:
  /// From the first message at or after `ms` on; with the mutex.
  Cursor(const GrowingSource& source, const std::deque<Message>& messages, double ms)
      : source_(source), messages_(messages) {
    const auto first = std::find_if(messages.begin(), messages.end(),
                                    [ms](const Message& one) { return static_cast<double>(one.media_time) >= ms; });
    next_ = static_cast<std::size_t>(first - messages.begin());
  }
  [[nodiscard]] const Message* current() const override {
    const std::lock_guard lock(source_.mutex_);
    return next_ < messages_.size() ? &messages_[next_] : nullptr;
  }
  void advance() override { ++next_; }

 private:
  const GrowingSource& source_;
  const std::deque<Message>& messages_;
  std::size_t next_ = 0;
};

Result<double> GrowingSource::add_part(const PerformanceScript& part, double lead, double length) {
  const std::lock_guard lock(mutex_);
  auto begin = face_.add(part, lead, length, played_ + ahead_ms);
  if (begin && bytes_now() > most_bytes) return Error{ErrorCode::too_large, "", "takes too much memory"};
  return begin;
}

Status GrowingSource::add_sound(std::vector<SoundPacket> packets) {
  const std::lock_guard lock(mutex_);
  for (auto& packet : packets) {
    sound_bytes_ += sizeof(packet) + packet.packet.capacity();
    sound_.push_back(std::move(packet));
  }
  if (bytes_now() > most_bytes) return Error{ErrorCode::too_large, "", "takes too much memory"};
  return Unit{};
}

Status GrowingSource::add_texts(std::vector<SpeechText> texts) {
  const std::lock_guard lock(mutex_);
  for (auto& text : texts) {
    text_bytes_ += sizeof(text) + text.text.capacity() + text.score.capacity();
    texts_.push_back(std::move(text));
  }
  if (bytes_now() > most_bytes) return Error{ErrorCode::too_large, "", "takes too much memory"};
  return Unit{};
}

void GrowingSource::finish() {
  const std::lock_guard lock(mutex_);
  making_.complete = true;
}

void GrowingSource::fail(std::string why) {
  const std::lock_guard lock(mutex_);
  making_ = {true, std::move(why)};
}

double GrowingSource::duration() const {
  const std::lock_guard lock(mutex_);
  return face_.duration();
}

Making GrowingSource::making() const {
  const std::lock_guard lock(mutex_);
  return making_;
}

FaceFrame GrowingSource::frame_at(double ms, double played_ms) const {
  const std::lock_guard lock(mutex_);
  played_ = std::max(played_, ms);
  return quantized(face_.frame_at(ms, played_ms), steps_);
}

std::unique_ptr<SoundCursor> GrowingSource::sound_from(double ms) const {
  const std::lock_guard lock(mutex_);
  return std::make_unique<Cursor<SoundPacket>>(*this, sound_, ms);
}

std::unique_ptr<TextCursor> GrowingSource::texts_from(double ms) const {
  const std::lock_guard lock(mutex_);
  return std::make_unique<Cursor<SpeechText>>(*this, texts_, ms);
}

std::size_t GrowingSource::bytes() const {
  const std::lock_guard lock(mutex_);
  return making_.complete ? bytes_now() : most_bytes;
}

}  // namespace semblante::streams

#include <bit>
#include <cassert>

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/state_codec.h"
#include "protocol/cpp/utf8.h"

namespace semblante {
namespace {

/// Writes the fields of one message in order. `last` is the base state of the differences of a batch.
class BinaryFieldWriter {
 public:
  BinaryFieldWriter(std::vector<std::uint8_t>& to, const FaceFrame& last) : to_(to), last_(last) {}

  void uint(const char*, std::uint64_t value, [[maybe_unused]] std::uint64_t max, Presence) {
    assert(value <= max);
    byte_io::append_varint(to_, value);
  }
  void real(const char*, double value, [[maybe_unused]] double min, [[maybe_unused]] double max, Presence) {
    assert(value >= min && value <= max);
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (unsigned i = 0; i < 8; ++i) to_.push_back(static_cast<std::uint8_t>(bits >> (8U * i)));
  }
  void boolean(const char*, bool value, Presence presence) {
    if (presence == Presence::appended && left_out(!value)) return;
    to_.push_back(value ? 1 : 0);
  }
  void text(const char*, const std::string& value, [[maybe_unused]] std::size_t max, Presence) {
    assert(value.size() <= max);
    assert(is_utf8({reinterpret_cast<const std::uint8_t*>(value.data()), value.size()}));
    byte_io::append_varint(to_, value.size());
    to_.insert(to_.end(), value.begin(), value.end());
  }
  void reals(const char* name, const std::vector<double>& values, [[maybe_unused]] std::size_t length, double min,
             double max, Presence presence) {
    assert(values.empty() || values.size() == length);
    byte_io::append_varint(to_, values.size());
    for (const double value : values) real(name, value, min, max, presence);
  }
  template <class E>
  void enumeration(const char*, E value, [[maybe_unused]] const EnumNames& names, Presence presence) {
    assert(static_cast<std::size_t>(value) < names.names.size());
    if (presence == Presence::appended && left_out(value == E{})) return;
    to_.push_back(static_cast<std::uint8_t>(value));
  }
  template <class T>
  void optional(const char*, const std::optional<T>& value) {
    to_.push_back(value.has_value() ? 1 : 0);
    if (value.has_value()) visit_fields(*value, *this);
  }
  void optional_real(const char* name, const std::optional<double>& value, double min, double max) {
    if (left_out(!value.has_value())) return;
    to_.push_back(1);
    real(name, *value, min, max, Presence::required);
  }
  void state(const char*, const FaceFrame& state) {
    assert(is_valid(state));
    append_state(to_, FaceFrame{}, state);
  }
  void frames(const char*, const std::vector<TimedFrame>& frames) {
    assert(!frames.empty() && frames.size() <= max_frames_per_message);
    byte_io::append_varint(to_, frames.size());
    const FaceFrame* before = &last_;
    std::uint32_t time = 0;
    for (const TimedFrame& frame : frames) {
      assert(is_valid(frame.state) && frame.time >= time && frame.time <= max_frame_time);
      byte_io::append_varint(to_, frame.time - time);
      append_state(to_, *before, frame.state);
      before = &frame.state;
      time = frame.time;
    }
  }

 private:
  /// Trailing appended fields with default values are omitted, as writers of earlier versions omit them. The default
  /// of each is one zero byte.
  bool left_out(bool is_default) {
    if (is_default) return ++left_out_, true;
    to_.insert(to_.end(), left_out_, 0);
    left_out_ = 0;
    return false;
  }

  std::vector<std::uint8_t>& to_;
  const FaceFrame& last_;
  std::size_t left_out_ = 0;  ///< number of appended fields omitted since the last written one
};

}  // namespace

std::vector<std::uint8_t> FrameEncoder::encode(const Message& message) {
  std::vector<std::uint8_t> bytes;
  encode(message, bytes);
  return bytes;
}

void FrameEncoder::encode(const Message& message, std::vector<std::uint8_t>& to) {
  const auto* keyframe = std::get_if<Keyframe>(&message);
  const auto* frames = std::get_if<Frames>(&message);
  assert(frames == nullptr || (last_.has_value() && "frames need a keyframe before them"));
  assert(frames == nullptr || frames->sequence == 0 || frames->sequence == last_sequence_ + 1);

  const FaceFrame neutral;
  BinaryFieldWriter writer(to, last_.has_value() ? *last_ : neutral);
  std::visit(
      [&]<class M>(const M& m) {
        to.push_back(MessageTraits<M>::type);
        visit_fields(m, writer);
      },
      message);
  if (keyframe != nullptr) {
    last_ = keyframe->state;
    last_sequence_ = keyframe->sequence;
  } else if (frames != nullptr) {
    last_ = frames->frames.back().state;
    last_sequence_ += frames->frames.size();
  }
}

}  // namespace semblante

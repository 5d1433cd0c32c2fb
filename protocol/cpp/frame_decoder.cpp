#include <bit>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/packed_codec.h"
#include "protocol/cpp/state_codec.h"
#include "protocol/cpp/utf8.h"

namespace semblante {
namespace {

/// Reads the fields of one message in order; keeps the first error and does not read further.
class BinaryFieldReader {
 public:
  BinaryFieldReader(std::span<const std::uint8_t> bytes, const std::optional<FaceFrame>& last)
      : in_(bytes), last_(last) {}

  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  template <class Int>
  void uint(const char* name, Int& value, std::uint64_t max, Presence) {
    if (error_) return;
    const std::uint64_t read = in_.varint();
    if (ended(name)) return;
    if (read > max) return fail(ErrorCode::out_of_range, name, "must be at most " + std::to_string(max));
    value = static_cast<Int>(read);
  }
  void real(const char* name, double& value, double min, double max, Presence) {
    if (error_) return;
    const auto bytes = in_.take(8);
    if (ended(name)) return;
    std::uint64_t bits = 0;
    for (unsigned i = 0; i < 8; ++i) bits |= static_cast<std::uint64_t>(bytes[i]) << (8U * i);
    value = std::bit_cast<double>(bits);
    if (!std::isfinite(value)) return fail(ErrorCode::not_finite, name, "must be finite");
    if (value < min || value > max) return fail(ErrorCode::out_of_range, name, "outside its range");
  }
  void boolean(const char* name, bool& value, Presence presence) {
    if (!ends_before(presence)) value = flag(name);
  }
  void text(const char* name, std::string& value, std::size_t max, Presence) {
    if (error_) return;
    const std::uint64_t size = in_.varint();
    if (ended(name)) return;
    if (size > max) return fail(ErrorCode::too_large, name, "must not exceed " + std::to_string(max) + " bytes");
    const auto bytes = in_.take(size);
    if (ended(name)) return;
    if (!is_utf8(bytes)) return fail(ErrorCode::malformed, name, "must be UTF-8");
    value.assign(bytes.begin(), bytes.end());
  }
  void reals(const char* name, std::vector<double>& values, std::size_t length, double min, double max,
             Presence presence) {
    if (error_) return;
    const std::uint64_t count = in_.varint();
    if (ended(name)) return;
    if (count != 0 && count != length) {
      return fail(ErrorCode::out_of_range, name, "must have 0 or " + std::to_string(length) + " elements");
    }
    values.assign(count, 0.0);
    for (double& value : values) real(name, value, min, max, presence);
  }
  template <class E>
  void enumeration(const char* name, E& value, const EnumNames& names, Presence presence) {
    if (error_ || ends_before(presence)) return;
    const std::uint8_t read = in_.u8();
    if (ended(name)) return;
    if (read >= names.names.size() && !names.open) return fail(ErrorCode::out_of_range, name, "not a known value");
    value = static_cast<E>(read < names.names.size() ? read : 0);
  }
  template <class T>
  void optional(const char* name, std::optional<T>& value) {
    if (!flag(name)) return;
    const std::string outer = prefix_;
    prefix_ = pointer(name);
    visit_fields(value.emplace(), *this);
    prefix_ = outer;
  }
  void optional_real(const char* name, std::optional<double>& value, double min, double max) {
    if (error_ || ends_before(Presence::appended) || !flag(name)) return;
    real(name, value.emplace(), min, max, Presence::required);
  }
  void state(const char* name, FaceFrame& state) {
    if (error_) return;
    state = FaceFrame{};
    if (const auto status = read_state(in_, state, pointer(name)); !status) error_ = status.error();
  }
  void frames(const char* name, std::vector<TimedFrame>& frames) {
    if (error_) return;
    if (!last_) return fail(ErrorCode::mismatch, "sequence", "frames before a keyframe");
    const std::uint64_t count = in_.varint();
    if (ended(name)) return;
    if (count == 0) return fail(ErrorCode::out_of_range, name, "must have at least one frame");
    if (count > max_frames_per_message) return fail(ErrorCode::too_large, name, "too many frames in a message");
    // A frame has at least two bytes, so this bounds the declared count by the remaining bytes.
    if (count > in_.remaining() / 2) return fail(ErrorCode::truncated, name, "fewer frames than declared");
    frames.reserve(count);
    TimedFrame frame{0, *last_};
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::string where = pointer(name) + "/" + std::to_string(i);
      const std::uint64_t later = in_.varint();
      if (in_.failed()) return fail(ErrorCode::truncated, name, "the message ends within a frame");
      if (later > max_frame_time - frame.time) {
        error_ = Error{ErrorCode::out_of_range, where + "/time", "more than a day after media_time"};
        return;
      }
      frame.time += static_cast<std::uint32_t>(later);
      if (const auto status = read_state(in_, frame.state, where); !status) {
        error_ = status.error();
        return;
      }
      frames.push_back(frame);
    }
  }

 private:
  /// Whether the message of a writer of an earlier version ends before this appended field.
  [[nodiscard]] bool ends_before(Presence presence) const {
    return presence == Presence::appended && in_.remaining() == 0;
  }
  [[nodiscard]] std::string pointer(const char* name) const { return prefix_ + "/" + name; }
  void fail(ErrorCode code, const char* name, std::string message) {
    if (!error_) error_ = Error{code, pointer(name), std::move(message)};
  }
  bool ended(const char* name) {
    if (in_.failed()) fail(ErrorCode::truncated, name, "the message ends within this field");
    return in_.failed();
  }
  bool flag(const char* name) {
    if (error_) return false;
    const std::uint8_t value = in_.u8();
    if (!ended(name) && value > 1) fail(ErrorCode::malformed, name, "must be 0 or 1");
    return value == 1;
  }

  byte_io::Reader in_;
  const std::optional<FaceFrame>& last_;
  std::optional<Error> error_;
  std::string prefix_;  ///< pointer of the structure being read
};

template <class M>
Result<Message> read_message(std::span<const std::uint8_t> body, const std::optional<FaceFrame>& last) {
  BinaryFieldReader reader(body, last);
  M message;
  visit_fields(message, reader);
  if (reader.error()) return *reader.error();
  return Message(std::move(message));  // bytes after the last field belong to a later version
}

template <class... M>
Result<Message> read_by_type(std::span<const std::uint8_t> bytes, const std::optional<FaceFrame>& last,
                             const std::variant<M...>* /*types*/) {
  std::optional<Result<Message>> result;
  const auto read = [&]<class T>(std::type_identity<T>) {
    result = read_message<T>(bytes.subspan(1), last);
    return true;
  };
  static_cast<void>(((MessageTraits<M>::type == bytes[0] && read(std::type_identity<M>())) || ...));
  if (!result) return Error{ErrorCode::unsupported, "/type", "no message has the type " + std::to_string(bytes[0])};
  return *std::move(result);
}

}  // namespace

Result<Message> FrameDecoder::decode(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return Error{ErrorCode::truncated, "/type", "the message is empty"};
  if (bytes.size() > max_binary_message_bytes) return Error{ErrorCode::too_large, "", "over 256 KiB"};
  if (is_packed_keyframe(bytes[0]) || is_packed_frames(bytes[0])) return decode_packed(bytes);
  auto result = read_by_type(bytes, last_, static_cast<const Message*>(nullptr));
  if (!result) return result;
  if (const auto* keyframe = std::get_if<Keyframe>(&*result)) {
    last_ = keyframe->state;
    last_sequence_ = keyframe->sequence;
    packed_.reset();
  } else if (auto* frames = std::get_if<Frames>(&*result)) {
    const std::uint64_t next = last_sequence_ + 1;
    if (frames->sequence == 0) frames->sequence = next;
    if (frames->sequence != next) {
      return Error{ErrorCode::mismatch, "/sequence",
                   "frame " + std::to_string(next) + " is expected, not " + std::to_string(frames->sequence)};
    }
    last_ = frames->frames.back().state;
    last_sequence_ += frames->frames.size();
  }
  return result;
}

Result<Message> FrameDecoder::decode_packed(std::span<const std::uint8_t> bytes) {
  if (is_packed_keyframe(bytes[0])) {
    PackedState state;
    auto keyframe = read_packed_keyframe(bytes, state);
    if (!keyframe) return std::move(keyframe).error();
    packed_ = state;
    last_.reset();
    return Message(*keyframe);
  }
  Frames frames;
  if (auto status = decode_frames(bytes, frames); !status) return std::move(status).error();
  return Message(std::move(frames));
}

Status FrameDecoder::decode_frames(std::span<const std::uint8_t> bytes, Frames& to) {
  assert(!bytes.empty() && is_packed_frames(bytes[0]));
  if (bytes.size() > max_binary_message_bytes) return Error{ErrorCode::too_large, "", "over 256 KiB"};
  if (!packed_) return Error{ErrorCode::mismatch, "/sequence", "packed frames before a packed keyframe"};
  return read_packed_frames(bytes, *packed_, to);
}

}  // namespace semblante

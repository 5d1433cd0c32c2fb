#include <bit>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "core/types/decimal.h"
#include "protocol/cpp/byte_io.h"
#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/opus_packet.h"
#include "protocol/cpp/packed_codec.h"
#include "protocol/cpp/packed_text.h"
#include "protocol/cpp/speech_score.h"
#include "protocol/cpp/utf8.h"

namespace semblante {
namespace {

/// Reads the fields of one message in order; keeps the first error and does not read further.
class BinaryFieldReader {
 public:
  explicit BinaryFieldReader(std::span<const std::uint8_t> bytes) : in_(bytes) {}

  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  template <class Int>
  void uint(const char* name, Int& value, std::uint64_t max, Presence) {
    if (error_) return;
    const std::uint64_t read = in_.varint();
    if (ended(name)) return;
    if (read > max) return fail(ErrorCode::out_of_range, name, "must be at most " + natural_text(max));
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
    const auto bytes = counted(name, max);
    if (error_) return;
    if (!is_utf8(bytes)) return fail(ErrorCode::malformed, name, "must be UTF-8");
    value.assign(bytes.begin(), bytes.end());
  }
  void reals(const char* name, std::vector<double>& values, std::size_t length, double min, double max,
             Presence presence) {
    if (error_) return;
    const std::uint64_t count = in_.varint();
    if (ended(name)) return;
    if (count != 0 && count != length) {
      return fail(ErrorCode::out_of_range, name, "must have 0 or " + natural_text(length) + " elements");
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
  void bytes(const char* name, std::vector<std::uint8_t>& value, std::size_t max, Presence) {
    if (error_) return;
    const auto bytes = counted(name, max);
    value.assign(bytes.begin(), bytes.end());
  }
  template <class T>
  void optional(const char* name, std::optional<T>& value, Presence presence) {
    if (error_ || ends_before(presence) || !flag(name)) return;
    const std::string outer = prefix_;
    prefix_ = pointer(name);
    visit_fields(value.emplace(), *this);
    prefix_ = outer;
  }
  void optional_real(const char* name, std::optional<double>& value, double min, double max) {
    if (error_ || ends_before(Presence::appended) || !flag(name)) return;
    real(name, value.emplace(), min, max, Presence::required);
  }

 private:
  /// A number of bytes and that many bytes; empty after an error.
  std::span<const std::uint8_t> counted(const char* name, std::size_t max) {
    const std::uint64_t size = in_.varint();
    if (ended(name)) return {};
    if (size > max) {
      fail(ErrorCode::too_large, name, "must not exceed " + natural_text(max) + " bytes");
      return {};
    }
    const auto bytes = in_.take(size);
    return ended(name) ? std::span<const std::uint8_t>() : bytes;
  }
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
  std::optional<Error> error_;
  std::string prefix_;  ///< pointer of the structure being read
};

template <class M>
Result<Message> read_message(std::span<const std::uint8_t> body) {
  BinaryFieldReader reader(body);
  M message;
  visit_fields(message, reader);
  if (reader.error()) return *reader.error();
  if constexpr (std::is_same_v<M, SoundPacket>) {
    if (auto status = check_sound(message); !status) return std::move(status).error();
  }
  if constexpr (std::is_same_v<M, SpeechText>) {
    if (auto status = check_text(message); !status) return std::move(status).error();
  }
  return Message(std::move(message));  // bytes after the last field belong to a later version
}

template <class M>
constexpr bool is_of_clients =
    std::is_same_v<M, Hello> || std::is_same_v<M, Spoken> || std::is_same_v<M, CaptionsWish> || std::is_same_v<M, Ping>;

template <bool from_server, class... M>
Result<Message> read_by_type(std::span<const std::uint8_t> bytes, const std::variant<M...>* /*types*/) {
  std::optional<Result<Message>> result;
  const auto read = [&]<class T>(std::type_identity<T>) {
    if constexpr (!is_packed<T> && !(from_server && is_of_clients<T>)) result = read_message<T>(bytes.subspan(1));
    return true;
  };
  static_cast<void>(((MessageTraits<M>::type == bytes[0] && read(std::type_identity<M>())) || ...));
  if (!result) return Error{ErrorCode::unsupported, "/type", "no message has the type " + natural_text(bytes[0])};
  return *std::move(result);
}

template <bool from_server>
Result<Message> read_any(std::span<const std::uint8_t> bytes, FrameDecoder& decoder,
                         std::optional<PackedState>& state) {
  if (bytes.empty()) return Error{ErrorCode::truncated, "/type", "the message is empty"};
  if (is_frames(bytes[0])) {
    Frames frames;
    if (auto status = decoder.decode_frames(bytes, frames); !status) return std::move(status).error();
    return Message(std::move(frames));
  }
  if (bytes.size() > max_binary_message_bytes) return Error{ErrorCode::too_large, "", "over 256 KiB"};
  if (from_server && bytes[0] == packed_text_type) {
    auto text = read_packed_text(bytes);
    if (!text) return std::move(text).error();
    return Message(*std::move(text));
  }
  if (!is_keyframe(bytes[0])) return read_by_type<from_server>(bytes, static_cast<const Message*>(nullptr));
  PackedState read;
  auto keyframe = read_packed_keyframe(bytes, read);
  if (!keyframe) return std::move(keyframe).error();
  state = read;
  return Message(*keyframe);
}

}  // namespace

Result<Message> FrameDecoder::decode(std::span<const std::uint8_t> bytes) {
  return read_any<false>(bytes, *this, state_);
}

Result<Message> FrameDecoder::decode_from_server(std::span<const std::uint8_t> bytes) {
  return read_any<true>(bytes, *this, state_);
}

Status FrameDecoder::decode_frames(std::span<const std::uint8_t> bytes, Frames& to) {
  assert(!bytes.empty() && is_frames(bytes[0]));
  if (bytes.size() > max_binary_message_bytes) return Error{ErrorCode::too_large, "", "over 256 KiB"};
  if (!state_) return Error{ErrorCode::mismatch, "/sequence", "frames before a keyframe"};
  return read_packed_frames(bytes, *state_, to);
}

}  // namespace semblante

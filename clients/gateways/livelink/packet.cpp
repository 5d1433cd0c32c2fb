#include "clients/gateways/livelink/packet.h"

#include <array>
#include <bit>
#include <cmath>

#include "protocol/cpp/utf8.h"

namespace semblante::livelink {
namespace {

constexpr std::uint8_t version = 6;
constexpr std::size_t value_count = 61;
constexpr double max_rate = 1000.0;

/// The first error is kept; later values are empty.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  void fail(ErrorCode code, const char* message) {
    if (!error_) error_ = Error{code, "byte " + std::to_string(at_), message};
  }

  std::span<const std::uint8_t> take(std::size_t count) {
    if (!error_ && bytes_.size() - at_ < count) fail(ErrorCode::truncated, "the packet ends within a value");
    if (error_) return {};
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }

  std::uint8_t u8() {
    const auto byte = take(1);
    return byte.empty() ? std::uint8_t{0} : byte[0];
  }
  std::uint32_t u32() {
    std::uint32_t value = 0;
    for (const std::uint8_t byte : take(4)) value = value << 8U | byte;
    return value;
  }
  std::int32_t i32() { return std::bit_cast<std::int32_t>(u32()); }
  float f32() {
    const auto value = std::bit_cast<float>(u32());
    if (!error_ && !std::isfinite(value)) fail(ErrorCode::not_finite, "a value is not a finite number");
    return value;
  }
  std::string text() {
    const std::uint32_t length = u32();
    if (length > max_name_bytes) fail(ErrorCode::too_large, "a name is longer than 256 bytes");
    const auto bytes = take(error_ ? 0 : length);
    if (!is_utf8(bytes)) fail(ErrorCode::malformed, "a name is not valid UTF-8");
    return {bytes.begin(), bytes.end()};
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  std::optional<Error> error_;
};

void read_time(Reader& reader, Packet& packet) {
  const std::int32_t frame = reader.i32();
  const float fraction = reader.f32();
  const std::int32_t numerator = reader.i32();
  const std::int32_t denominator = reader.i32();
  if (reader.error()) return;
  const double rate = denominator > 0 ? static_cast<double>(numerator) / denominator : 0.0;
  if (!(rate > 0.0 && rate <= max_rate))
    return reader.fail(ErrorCode::out_of_range, "the frame rate must be above 0 and at most 1000");
  if (fraction < 0.0F || fraction > 1.0F)
    return reader.fail(ErrorCode::out_of_range, "the fraction of a frame must be 0 to 1");
  packet.rate = rate;
  packet.seconds = (static_cast<double>(frame) + static_cast<double>(fraction)) / rate;
}

SeenFace read_face(Reader& reader) {
  std::array<float, value_count> values{};
  for (float& value : values) value = reader.f32();
  SeenFace face;
  for (std::size_t i = 0; i < arkit_count; ++i) face.coefficients[i] = values[i];
  face.head = {values[arkit_count], values[arkit_count + 1], values[arkit_count + 2]};
  return face;
}

}  // namespace

Result<Packet> read_packet(std::span<const std::uint8_t> bytes) {
  Reader reader(bytes);
  if (const std::uint8_t spoken = reader.u8(); !reader.error() && spoken != version) {
    return Error{
        ErrorCode::unsupported, "byte 0",
        "version " + std::to_string(spoken) + " of the Live Link Face protocol is not supported, only version 6"};
  }
  Packet packet;
  packet.device = reader.text();
  packet.subject = reader.text();
  if (!reader.error() && !reader.at_end()) read_time(reader, packet);
  if (!reader.error() && !reader.at_end()) {
    const std::uint8_t count = reader.u8();
    if (count == value_count) packet.face = read_face(reader);
    if (count != value_count && count != 0) reader.fail(ErrorCode::malformed, "the number of values must be 0 or 61");
  }
  if (!reader.error() && !reader.at_end()) reader.fail(ErrorCode::malformed, "bytes after the last value");
  if (reader.error()) return *reader.error();
  return packet;
}

}  // namespace semblante::livelink

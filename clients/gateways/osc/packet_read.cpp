#include <algorithm>
#include <bit>
#include <optional>
#include <string>

#include "clients/gateways/osc/packet.h"

namespace semblante::osc {
namespace {

constexpr std::string_view bundle_begin("#bundle\0", 8);
constexpr std::size_t time_tag_bytes = 8;

/// Big-endian, in steps of four bytes; the first error is kept and later values are empty.
class Reader {
 public:
  Reader(std::span<const std::uint8_t> bytes, std::size_t origin) : bytes_(bytes), origin_(origin) {}

  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }
  [[nodiscard]] std::size_t position() const { return origin_ + at_; }
  [[nodiscard]] std::uint8_t peek() const { return at_ < bytes_.size() ? bytes_[at_] : 0; }

  void fail(ErrorCode code, const char* message) {
    if (!error_) error_ = Error{code, "byte " + std::to_string(position()), message};
    at_ = bytes_.size();
  }

  std::span<const std::uint8_t> take(std::size_t count) {
    if (error_ || bytes_.size() - at_ < count) {
      fail(ErrorCode::truncated, "the packet ends within a value");
      return {};
    }
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }

  std::uint32_t u32() {
    std::uint32_t value = 0;
    for (const std::uint8_t byte : take(4)) value = value << 8U | byte;
    return value;
  }
  std::uint64_t u64() {
    const std::uint64_t high = u32();
    return high << 32U | u32();
  }

  /// Zero-terminated and filled with zeros to a multiple of four.
  std::string_view text() {
    const auto rest = bytes_.subspan(at_);
    const auto end = std::find(rest.begin(), rest.end(), std::uint8_t{0});
    if (error_ || end == rest.end()) {
      fail(ErrorCode::truncated, "a string has no terminating zero");
      return {};
    }
    const auto length = static_cast<std::size_t>(end - rest.begin());
    const auto all = take(length + 1);
    pad(length + 1);
    return error_ ? std::string_view() : std::string_view(reinterpret_cast<const char*>(all.data()), length);
  }

  Blob blob() {
    const std::uint32_t length = u32();
    const auto all = take(length);
    pad(length);
    return error_ ? Blob() : all;
  }

 private:
  void pad(std::size_t length) {
    for (const std::uint8_t byte : take((4 - length % 4) % 4)) {
      if (byte != 0) return fail(ErrorCode::malformed, "the padding is not zero");
    }
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t origin_;
  std::size_t at_ = 0;
  std::optional<Error> error_;
};

/// The value of one tag; nullopt for a tag that has none, such as the brackets of an array.
std::optional<Argument> read_argument(char tag, Reader& reader) {
  switch (tag) {
    case 'i':
    case 'c':
    case 'r':
      return Argument(std::bit_cast<std::int32_t>(reader.u32()));
    case 'f':
      return Argument(std::bit_cast<float>(reader.u32()));
    case 's':
    case 'S':
      return Argument(reader.text());
    case 'b':
      return Argument(reader.blob());
    case 'h':
      return Argument(std::bit_cast<std::int64_t>(reader.u64()));
    case 'd':
      return Argument(std::bit_cast<double>(reader.u64()));
    case 't':
      return Argument(TimeTag{reader.u64()});
    case 'm':
      reader.u32();
      return Argument(Nothing{});
    case 'T':
      return Argument(true);
    case 'F':
      return Argument(false);
    case 'N':
    case 'I':
      return Argument(Nothing{});
    case '[':
    case ']':
      return std::nullopt;
    default:
      reader.fail(ErrorCode::malformed, "unknown type tag");
      return std::nullopt;
  }
}

Result<Message> read_message(std::span<const std::uint8_t> bytes, std::size_t origin) {
  Reader reader(bytes, origin);
  Message message;
  message.address = reader.text();
  if (!reader.error() && !message.address.starts_with('/')) {
    return Error{ErrorCode::malformed, "byte " + std::to_string(origin), "an address must begin with a slash"};
  }
  if (reader.error() || reader.at_end()) {
    return reader.error() ? Result<Message>(*reader.error()) : Result<Message>(std::move(message));
  }
  if (reader.peek() != ',') reader.fail(ErrorCode::malformed, "type tags must begin with a comma");
  std::string_view tags = reader.text();
  if (tags.size() > max_arguments + 1) reader.fail(ErrorCode::too_large, "more than 64 arguments");
  tags.remove_prefix(std::min<std::size_t>(tags.size(), 1));
  for (const char tag : tags) {
    if (reader.error()) break;
    if (auto argument = read_argument(tag, reader)) message.arguments.push_back(*argument);
  }
  if (!reader.at_end()) reader.fail(ErrorCode::malformed, "more bytes than the type tags declare");
  if (reader.error()) return *reader.error();
  return message;
}

Status read_into(Packet& packet, std::span<const std::uint8_t> bytes, std::size_t origin, std::size_t depth) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!text.starts_with(bundle_begin)) {
    auto message = read_message(bytes, origin);
    if (!message) return std::move(message).error();
    packet.messages.push_back(*std::move(message));
    return Unit{};
  }
  if (depth == max_bundle_depth) {
    return Error{ErrorCode::too_large, "byte " + std::to_string(origin), "bundles are nested more than 8 deep"};
  }
  Reader reader(bytes, origin);
  reader.take(bundle_begin.size() + time_tag_bytes);
  while (!reader.error() && !reader.at_end()) {
    const std::uint32_t size = reader.u32();
    const std::size_t at = reader.position();
    if (!reader.error() && (size == 0 || size % 4 != 0)) {
      reader.fail(ErrorCode::malformed, "the size of a bundle's element must be a positive multiple of four");
    }
    const auto element = reader.take(size);
    if (reader.error()) break;
    if (auto read = read_into(packet, element, at, depth + 1); !read) return read;
  }
  return reader.error() ? Status(*reader.error()) : Status(Unit{});
}

}  // namespace

Result<Packet> read_packet(std::span<const std::uint8_t> bytes) {
  if (bytes.size() > max_packet_bytes) {
    return Error{ErrorCode::too_large, "", "the packet is larger than a UDP packet can be"};
  }
  if (bytes.empty() || bytes.size() % 4 != 0) {
    return Error{ErrorCode::truncated, "byte " + std::to_string(bytes.size()),
                 "the size of a packet must be a positive multiple of four bytes"};
  }
  Packet packet;
  packet.is_bundle = bytes[0] == '#';
  if (auto read = read_into(packet, bytes, 0, 0); !read) return std::move(read).error();
  return packet;
}

}  // namespace semblante::osc

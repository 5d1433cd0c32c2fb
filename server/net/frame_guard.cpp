#include "server/net/frame_guard.h"

#include <algorithm>

namespace semblante::net {

namespace {

// RFC 6455 section 5.2.
constexpr unsigned final_bit = 0x80, opcode_bits = 0x0F, control_bit = 0x08, opcode_of_close = 0x08;
constexpr unsigned mask_bit = 0x80, length_bits = 0x7F, two_byte_length = 126, eight_byte_length = 127;
constexpr std::size_t fixed_bytes = 2, mask_bytes = 4;

std::size_t bytes_of_length(unsigned length) {
  return length == two_byte_length ? 2 : length == eight_byte_length ? 8 : 0;
}

}  // namespace

std::optional<std::string_view> FrameGuard::look(std::string_view bytes) {
  while (!bytes.empty() && !over_) {
    if (payload_left_ > 0) {
      const auto skipped = static_cast<std::size_t>(std::min<std::uint64_t>(payload_left_, bytes.size()));
      payload_left_ -= skipped;
      bytes.remove_prefix(skipped);
      continue;
    }
    header_[header_size_++] = static_cast<unsigned char>(bytes.front());
    bytes.remove_prefix(1);
    if (header_size_ < fixed_bytes || header_size_ < header_bytes()) continue;
    payload_left_ = payload_bytes();
    header_size_ = 0;
    if (const auto words = count_frame()) {
      over_ = true;
      return words;
    }
  }
  return std::nullopt;
}

std::size_t FrameGuard::header_bytes() const {
  return fixed_bytes + bytes_of_length(header_[1] & length_bits) + ((header_[1] & mask_bit) != 0 ? mask_bytes : 0);
}

std::uint64_t FrameGuard::payload_bytes() const {
  const unsigned length = header_[1] & length_bits;
  const auto count = bytes_of_length(length);
  if (count == 0) return length;
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = (value << 8U) | header_.at(fixed_bytes + i);
  return value;
}

std::optional<std::string_view> FrameGuard::count_frame() {
  const bool is_control = (header_[0] & control_bit) != 0;
  if (is_control) {
    if ((header_[0] & opcode_bits) == opcode_of_close || controls_.take(1, Clock::now())) return std::nullopt;
    return "sends too many pings";
  }
  if ((header_[0] & final_bit) != 0) {
    fragments_of_message_ = 0;
    return std::nullopt;
  }
  if (++fragments_of_message_ > max_fragments_) return "sends a message in too many fragments";
  if (!fragments_.take(1, Clock::now())) return "sends too many fragments of messages";
  return std::nullopt;
}

}  // namespace semblante::net

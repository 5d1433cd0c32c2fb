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

std::optional<std::string_view> FrameGuard::look(std::string_view bytes, Clock::time_point now) {
  if (over_ || bytes.empty()) return std::nullopt;
  auto words = look_at_frames(bytes, now);
  if (!words && begin_ && now > *begin_ + limits_.body_time(bytes_)) words = "sends a message too slowly";
  over_ = words.has_value();
  return words;
}

std::optional<std::string_view> FrameGuard::look_at_frames(std::string_view bytes, Clock::time_point now) {
  while (!bytes.empty()) {
    if (!begin_) begin_ = now, bytes_ = 0;
    const auto passed =
        payload_left_ > 0 ? static_cast<std::size_t>(std::min<std::uint64_t>(payload_left_, bytes.size())) : 1;
    if (payload_left_ > 0) {
      payload_left_ -= passed;
    } else {
      header_[header_size_++] = static_cast<unsigned char>(bytes.front());
    }
    bytes.remove_prefix(passed);
    bytes_ += passed;
    if (header_size_ >= fixed_bytes && header_size_ >= header_bytes()) {
      payload_left_ = payload_bytes();
      header_size_ = 0;
      if (const auto words = count_frame(now)) return words;
    }
    if (header_size_ == 0 && payload_left_ == 0 && ends_message_) begin_.reset();
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

std::optional<std::string_view> FrameGuard::count_frame(Clock::time_point now) {
  const bool is_control = (header_[0] & control_bit) != 0;
  if (is_control) {
    ends_message_ = fragments_of_message_ == 0;
    if ((header_[0] & opcode_bits) == opcode_of_close || controls_.take(1, now)) return std::nullopt;
    return "sends too many pings";
  }
  ends_message_ = (header_[0] & final_bit) != 0;
  if (ends_message_) {
    fragments_of_message_ = 0;
    return std::nullopt;
  }
  if (++fragments_of_message_ > limits_.max_fragments) return "sends a message in too many fragments";
  if (!fragments_.take(1, now)) return "sends too many fragments of messages";
  return std::nullopt;
}

}  // namespace semblante::net

#include "server/net/frame_guard.h"

#include <algorithm>

#include "core/types/printable.h"

namespace semblante::net {

namespace {

// RFC 6455 section 5.2.
constexpr unsigned final_bit = 0x80, opcode_bits = 0x0F, control_bit = 0x08, opcode_of_close = 0x08;
constexpr unsigned mask_bit = 0x80, length_bits = 0x7F, two_byte_length = 126, eight_byte_length = 127;
constexpr std::size_t fixed_bytes = 2, mask_bytes = 4;
// Sections 7.4.1 and 7.4.2: the codes that there can be end before this one.
constexpr unsigned end_of_codes = 5000;
constexpr std::size_t code_bytes = 2, most_control_bytes = 125;

std::size_t bytes_of_length(unsigned length) {
  return length == two_byte_length ? 2 : length == eight_byte_length ? 8 : 0;
}

}  // namespace

std::optional<FrameGuard::Fault> FrameGuard::look(std::string_view bytes, Clock::time_point now) {
  if (over_ || bytes.empty()) return std::nullopt;
  auto fault = look_at_frames(bytes, now);
  if (!fault && begin_ && now > *begin_ + limits_.body_time(bytes_))
    fault = Fault{"sends a message too slowly", policy_violation};
  over_ = fault.has_value();
  return fault;
}

std::optional<FrameGuard::Fault> FrameGuard::look_at_frames(std::string_view bytes, Clock::time_point now) {
  while (!bytes.empty()) {
    if (!begin_) begin_ = now, bytes_ = 0;
    const auto passed =
        payload_left_ > 0 ? static_cast<std::size_t>(std::min<std::uint64_t>(payload_left_, bytes.size())) : 1;
    if (payload_left_ > 0) {
      payload_left_ -= passed;
      if (const auto fault = look_at_close(bytes.substr(0, passed))) return fault;
    } else {
      header_[header_size_++] = static_cast<unsigned char>(bytes.front());
    }
    bytes.remove_prefix(passed);
    bytes_ += passed;
    if (header_size_ >= fixed_bytes && header_size_ >= header_bytes()) {
      payload_left_ = payload_bytes();
      expect_close();
      header_size_ = 0;
      if (const auto fault = count_frame(now)) return fault;
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

std::optional<FrameGuard::Fault> FrameGuard::count_frame(Clock::time_point now) {
  const bool is_control = (header_[0] & control_bit) != 0;
  if (is_control) {
    ends_message_ = fragments_of_message_ == 0;
    if ((header_[0] & opcode_bits) == opcode_of_close || controls_.take(1, now)) return std::nullopt;
    return Fault{"sends too many pings", policy_violation};
  }
  ends_message_ = (header_[0] & final_bit) != 0;
  if (ends_message_) {
    fragments_of_message_ = 0;
    return std::nullopt;
  }
  if (++fragments_of_message_ > limits_.max_fragments)
    return Fault{"sends a message in too many fragments", policy_violation};
  if (!fragments_.take(1, now)) return Fault{"sends too many fragments of messages", policy_violation};
  return std::nullopt;
}

/// At the end of a header.
void FrameGuard::expect_close() {
  closes_ = (header_[0] & opcode_bits) == opcode_of_close && (header_[1] & mask_bit) != 0 &&
            payload_left_ >= code_bytes && payload_left_ <= most_control_bytes;
  close_size_ = 0;
}

std::optional<FrameGuard::Fault> FrameGuard::look_at_close(std::string_view payload) {
  if (!closes_) return std::nullopt;
  for (const char c : payload) {
    // Control frames have the short form of a length, so the mask follows the fixed bytes.
    const auto mask = header_.at(fixed_bytes + close_size_ % mask_bytes);
    close_.at(close_size_++) = static_cast<char>(static_cast<unsigned char>(c) ^ mask);
  }
  if (payload_left_ > 0) return std::nullopt;
  const std::string_view all(close_.data(), close_size_), reason = all.substr(code_bytes);
  const unsigned code = static_cast<unsigned char>(all[0]) << 8U | static_cast<unsigned char>(all[1]);
  if (code >= end_of_codes) return Fault{"closes with a code that there is not", protocol_error};
  if (utf8_end(reason) < reason.size()) return Fault{"closes with a reason that is not UTF-8", invalid_payload};
  return std::nullopt;
}

}  // namespace semblante::net

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Little-endian integers and LEB128 varints over byte spans.
namespace semblante::byte_io {

inline void put_u16(std::uint8_t* to, std::uint16_t value) {
  to[0] = static_cast<std::uint8_t>(value);
  to[1] = static_cast<std::uint8_t>(value >> 8U);
}
inline void put_u32(std::uint8_t* to, std::uint32_t value) {
  for (unsigned i = 0; i < 4; ++i) to[i] = static_cast<std::uint8_t>(value >> (8U * i));
}
inline std::uint16_t get_u16(const std::uint8_t* from) { return static_cast<std::uint16_t>(from[0] | from[1] << 8); }
inline std::uint32_t get_u32(const std::uint8_t* from) {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < 4; ++i) value |= static_cast<std::uint32_t>(from[i]) << (8U * i);
  return value;
}

inline void append_varint(std::vector<std::uint8_t>& to, std::uint64_t value) {
  for (; value >= 0x80U; value >>= 7U) to.push_back(static_cast<std::uint8_t>(value | 0x80U));
  to.push_back(static_cast<std::uint8_t>(value));
}

/// Reads forward; a read past the end, or a varint over 64 bits, sets `failed` and gives 0.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint8_t u8() {
    if (at_ >= bytes_.size()) return failed_ = true, std::uint8_t{0};
    return bytes_[at_++];
  }
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const std::uint8_t byte = u8();
      const std::uint64_t bits = byte & 0x7FU;
      if (shift == 63 && bits > 1) break;
      value |= bits << shift;
      if ((byte & 0x80U) == 0U) return value;
    }
    failed_ = true;
    return 0;
  }
  /// The next `count` bytes; empty (and `failed`) when fewer are left.
  std::span<const std::uint8_t> take(std::size_t count) {
    if (count > remaining()) return failed_ = true, std::span<const std::uint8_t>();
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }
  [[nodiscard]] std::size_t remaining() const { return bytes_.size() - at_; }
  [[nodiscard]] std::size_t position() const { return at_; }
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

}  // namespace semblante::byte_io

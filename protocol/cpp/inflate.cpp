#include "protocol/cpp/inflate.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

namespace semblante {
namespace {

constexpr int max_code_bits = 15;
constexpr int fast_bits = 9;
constexpr int literal_codes = 288;
constexpr int distance_codes = 30;

/// A canonical Huffman code. Codes of up to `fast_bits` bits are looked up at once, the others bit by bit.
class HuffmanCode {
 public:
  /// Returns false for lengths that are no prefix code. Incomplete codes are allowed only with one symbol, as in zlib.
  bool set(std::span<const std::uint8_t> lengths) {
    count_.fill(0);
    for (const std::uint8_t length : lengths) ++count_[length];
    const int used = static_cast<int>(lengths.size()) - count_[0];
    count_[0] = 0;
    int left = 1;
    std::array<std::uint16_t, max_code_bits + 2> offset{};
    for (int bits = 1; bits <= max_code_bits; ++bits) {
      left = left * 2 - count_[bits];
      if (left < 0) return false;
      offset[bits + 1] = static_cast<std::uint16_t>(offset[bits] + count_[bits]);
    }
    if (left > 0 && !(used == 0 || (used == 1 && count_[1] == 1))) return false;
    for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
      if (lengths[symbol] != 0) symbol_[offset[lengths[symbol]]++] = static_cast<std::uint16_t>(symbol);
    }
    fill_fast();
    return true;
  }

  /// Number of bits of the code at the start of `bits` (its first bit is the lowest), and its symbol; 0 bits: there is
  /// none.
  int find(std::uint32_t bits, int& symbol) const {
    if (const std::uint16_t entry = fast_[bits & ((1U << fast_bits) - 1U)]; entry != 0) {
      symbol = entry >> 4U;
      return entry & 15U;
    }
    int code = 0;
    int first = 0;
    int index = 0;
    for (int length = 1; length <= max_code_bits; ++length, bits >>= 1U) {
      code |= static_cast<int>(bits & 1U);
      if (code - first < count_[length]) {
        symbol = symbol_[index + code - first];
        return length;
      }
      index += count_[length];
      first = (first + count_[length]) * 2;
      code *= 2;
    }
    return 0;
  }

 private:
  void fill_fast() {
    fast_.fill(0);
    unsigned code = 0;
    int index = 0;
    for (int length = 1; length <= fast_bits; ++length, code *= 2) {
      for (int i = 0; i < count_[length]; ++i, ++code, ++index) {
        unsigned reversed = 0;
        for (int bit = 0; bit < length; ++bit) reversed |= (code >> bit & 1U) << (length - 1 - bit);
        for (unsigned at = reversed; at < 1U << fast_bits; at += 1U << length)
          fast_[at] = static_cast<std::uint16_t>(symbol_[index] << 4 | length);
      }
    }
  }

  std::array<std::int16_t, max_code_bits + 1> count_{};  ///< by length
  std::array<std::uint16_t, literal_codes> symbol_{};    ///< by rising code
  std::array<std::uint16_t, 1U << fast_bits> fast_{};    ///< symbol << 4 | length; 0: longer
};

class Inflater {
 public:
  Inflater(std::span<const std::uint8_t> packed, std::span<std::uint8_t> raw) : packed_(packed), raw_(raw) {}

  bool run() {
    // Deflate, a window of at most 32 KiB, no preset dictionary.
    if (packed_.size() < 2 || (packed_[0] & 15U) != 8 || packed_[0] >> 4U > 7 || (packed_[1] & 32U) != 0 ||
        (packed_[0] * 256U + packed_[1]) % 31 != 0) {
      return false;
    }
    at_ = 2;
    bool is_last = false;
    while (!is_last) {
      is_last = take(1) != 0;
      const std::uint32_t type = take(2);
      if (failed_) return false;
      const bool read = type == 0 ? stored() : type == 1 ? fixed() : type == 2 && dynamic();
      if (!read) return false;
    }
    // The rest of the last byte is not used.
    at_ -= static_cast<std::size_t>(held_ / 8);
    if (packed_.size() - at_ != 4 || put_ != raw_.size()) return false;
    std::uint32_t expected = 0;
    for (; at_ < packed_.size(); ++at_) expected = expected << 8U | packed_[at_];
    return adler32() == expected;
  }

 private:
  void fill(int count) {
    while (held_ < count && at_ < packed_.size()) {
      bits_ |= std::uint64_t{packed_[at_++]} << static_cast<unsigned>(held_);
      held_ += 8;
    }
  }
  void drop(int count) {
    if (count > held_) {
      failed_ = true;
      return;
    }
    bits_ >>= static_cast<unsigned>(count);
    held_ -= count;
  }
  std::uint32_t take(int count) {
    fill(count);
    const auto value = static_cast<std::uint32_t>(bits_ & ((std::uint64_t{1} << static_cast<unsigned>(count)) - 1U));
    drop(count);
    return failed_ ? 0 : value;
  }
  /// -1: the bits are no code
  int symbol(const HuffmanCode& code) {
    fill(max_code_bits);
    int found = -1;
    const int length = code.find(static_cast<std::uint32_t>(bits_), found);
    if (length == 0) return -1;
    drop(length);
    return failed_ ? -1 : found;
  }

  bool stored() {
    drop(held_ % 8);
    const std::uint32_t size = take(16);
    const std::uint32_t inverse = take(16);
    if (failed_ || (size ^ inverse) != 0xFFFFU) return false;
    at_ -= static_cast<std::size_t>(held_ / 8);  // what was read ahead
    bits_ = 0;
    held_ = 0;
    if (size > packed_.size() - at_ || size > raw_.size() - put_) return false;
    if (size > 0) std::memcpy(&raw_[put_], &packed_[at_], size);
    at_ += size;
    put_ += size;
    return true;
  }

  bool fixed() {
    std::array<std::uint8_t, literal_codes> lengths{};
    for (std::size_t i = 0; i < lengths.size(); ++i)
      lengths[i] = static_cast<std::uint8_t>(i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8);
    std::array<std::uint8_t, 32> fives{};
    fives.fill(5);
    return literals_.set(lengths) && distances_.set(fives) && codes();
  }

  bool dynamic() {
    static constexpr std::array<std::uint8_t, 19> order = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                           11, 4,  12, 3, 13, 2, 14, 1, 15};
    const std::size_t literal_count = take(5) + 257;
    const std::size_t distance_count = take(5) + 1;
    const std::size_t length_count = take(4) + 4;
    if (failed_ || literal_count > 286 || distance_count > distance_codes) return false;
    std::array<std::uint8_t, literal_codes + 32> lengths{};
    for (std::size_t i = 0; i < length_count; ++i) lengths[order[i]] = static_cast<std::uint8_t>(take(3));
    if (failed_ || !literals_.set(std::span(lengths).first(order.size()))) return false;
    lengths.fill(0);
    for (std::size_t i = 0; i < literal_count + distance_count;) {
      const int code = symbol(literals_);
      if (code < 0) return false;
      if (code < 16) {
        lengths[i++] = static_cast<std::uint8_t>(code);
        continue;
      }
      if (code == 16 && i == 0) return false;
      const std::uint8_t repeated = code == 16 ? lengths[i - 1] : std::uint8_t{0};
      const std::uint32_t times = code == 16 ? 3 + take(2) : code == 17 ? 3 + take(3) : 11 + take(7);
      if (failed_ || times > literal_count + distance_count - i) return false;
      for (std::uint32_t k = 0; k < times; ++k) lengths[i++] = repeated;
    }
    if (lengths[256] == 0) return false;  // no end of the block
    return literals_.set(std::span(lengths).first(literal_count)) &&
           distances_.set(std::span(lengths).subspan(literal_count, distance_count)) && codes();
  }

  bool codes() {
    for (;;) {
      const int literal = symbol(literals_);
      if (literal < 0) return false;
      if (literal == 256) return true;
      if (literal < 256) {
        if (put_ == raw_.size()) return false;
        raw_[put_++] = static_cast<std::uint8_t>(literal);
        continue;
      }
      if (!copy(literal - 257)) return false;
    }
  }

  bool copy(int length_code) {
    // Four codes for each number of extra bits of a length, two for each of a distance.
    std::size_t length = 258;
    if (length_code > 28) return false;
    if (length_code < 8) {
      length = static_cast<std::size_t>(length_code) + 3;
    } else if (length_code < 28) {
      const int extra = length_code / 4 - 1;
      length = (static_cast<std::size_t>(4 + length_code % 4) << extra) + 3 + take(extra);
    }
    const int distance_code = symbol(distances_);
    if (distance_code < 0 || distance_code >= distance_codes) return false;
    std::size_t distance = static_cast<std::size_t>(distance_code) + 1;
    if (distance_code >= 4) {
      const int extra = distance_code / 2 - 1;
      distance = (static_cast<std::size_t>(2 + distance_code % 2) << extra) + 1 + take(extra);
    }
    if (failed_ || distance > put_ || length > raw_.size() - put_) return false;
    for (; length > 0; --length, ++put_) raw_[put_] = raw_[put_ - distance];
    return true;
  }

  [[nodiscard]] std::uint32_t adler32() const {
    constexpr std::uint32_t base = 65521;
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    constexpr std::size_t without_overflow = 5552;
    for (std::size_t i = 0; i < raw_.size();) {
      for (const std::size_t end = i + std::min(without_overflow, raw_.size() - i); i < end; ++i) b += a += raw_[i];
      a %= base;
      b %= base;
    }
    return b << 16U | a;
  }

  std::span<const std::uint8_t> packed_;
  std::span<std::uint8_t> raw_;
  std::size_t at_ = 0;   ///< next byte of packed_
  std::size_t put_ = 0;  ///< next byte of raw_
  std::uint64_t bits_ = 0;
  int held_ = 0;  ///< number of bits in bits_
  bool failed_ = false;
  HuffmanCode literals_;
  HuffmanCode distances_;
};

}  // namespace

bool inflate_zlib(std::span<const std::uint8_t> packed, std::span<std::uint8_t> raw) {
  return Inflater(packed, raw).run();
}

std::uint32_t crc32(std::uint32_t crc, std::span<const std::uint8_t> bytes) {
  static constexpr std::array<std::uint32_t, 16> table = [] {
    std::array<std::uint32_t, 16> values{};
    for (std::uint32_t i = 0; i < values.size(); ++i) {
      values[i] = i;
      for (int bit = 0; bit < 4; ++bit) values[i] = values[i] >> 1U ^ ((values[i] & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    return values;
  }();
  crc = ~crc;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    crc = crc >> 4U ^ table[crc & 15U];
    crc = crc >> 4U ^ table[crc & 15U];
  }
  return ~crc;
}

}  // namespace semblante

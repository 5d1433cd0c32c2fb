#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Binary range coding with fixed probabilities: SPEC.md, "Range coder". Integers only, so that every language produces
/// the same bytes.
namespace semblante {

/// A probability is that of a 1, in 4096ths, 1 to 4095.
inline constexpr unsigned probability_bits = 12;

class RangeEncoder {
 public:
  static constexpr bool decodes = false;

  /// Appends to `to`; carries never change bytes before its current end.
  explicit RangeEncoder(std::vector<std::uint8_t>& to) : to_(to) {}

  int bit(std::uint32_t probability, int value) {
    const std::uint32_t bound = (range_ >> probability_bits) * probability;
    if (value != 0) {
      range_ = bound;
    } else {
      low_ += bound;
      range_ -= bound;
    }
    while (range_ < (1U << 24U)) shift();
    return value;
  }
  /// Codes the low `count` bits of `value`, high bits first, each with probability 1/2.
  std::uint64_t bits(unsigned count, std::uint64_t value) {
    while (count-- > 0) {
      range_ >>= 1U;
      if ((value >> count & 1U) != 0) low_ += range_;
      while (range_ < (1U << 24U)) shift();
    }
    return value;
  }
  /// Writes the shortest end that decodes correctly when the decoder appends zeros.
  void finish() {
    for (unsigned count = 0; count <= 4; ++count) {
      const std::uint64_t rest = (std::uint64_t{1} << (32 - 8 * count)) - 1;
      const std::uint64_t value = (low_ + rest) & ~rest;
      if (value - low_ >= range_) continue;
      low_ = value;
      for (unsigned i = 0; i < count; ++i) shift();
      carry();
      return;
    }
  }

 private:
  void carry() {
    if (low_ >> 32U == 0) return;
    std::size_t at = to_.size();
    while (++to_[--at] == 0) {
    }
    low_ &= 0xFFFFFFFFU;
  }
  void shift() {
    carry();
    to_.push_back(static_cast<std::uint8_t>(low_ >> 24U));
    low_ = (low_ << 8U) & 0xFFFFFFFFU;
    range_ <<= 8U;
  }

  std::vector<std::uint8_t>& to_;
  std::uint64_t low_ = 0;  ///< lower end of the current interval, relative to the written bytes; bit 32 is a carry
  std::uint32_t range_ = 0xFFFFFFFFU;
};

/// Decodes untrusted bytes.
class RangeDecoder {
 public:
  static constexpr bool decodes = true;

  explicit RangeDecoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) code_ = code_ << 8U | next();
    valid_ = code_ < range_;  // then true for all later steps
  }

  /// The second argument exists for the interface of the encoder only.
  int bit(std::uint32_t probability, int /*value*/ = 0) {
    const std::uint32_t bound = (range_ >> probability_bits) * probability;
    const bool one = code_ < bound;
    if (one) {
      range_ = bound;
    } else {
      code_ -= bound;
      range_ -= bound;
    }
    normalize();
    return one ? 1 : 0;
  }
  std::uint64_t bits(unsigned count, std::uint64_t /*value*/ = 0) {
    std::uint64_t value = 0;
    while (count-- > 0) {
      range_ >>= 1U;
      const bool one = code_ >= range_;
      if (one) code_ -= range_;
      value = value << 1U | (one ? 1U : 0U);
      normalize();
    }
    return value;
  }
  /// Whether more than the four bytes that an encoder may omit were read past the end.
  [[nodiscard]] bool truncated() const { return at_ > bytes_.size() + 4; }
  /// Whether the first bytes can come from an encoder.
  [[nodiscard]] bool valid() const { return valid_; }
  /// Whether bytes remain that an encoder would not have written.
  [[nodiscard]] bool has_more() const { return at_ < bytes_.size(); }

 private:
  std::uint8_t next() {
    const std::size_t at = at_++;
    return at < bytes_.size() ? bytes_[at] : std::uint8_t{0};
  }
  void normalize() {
    while (range_ < (1U << 24U)) {
      range_ <<= 8U;
      code_ = code_ << 8U | next();
    }
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;  ///< bytes read, those after the end as zeros
  std::uint32_t code_ = 0;
  std::uint32_t range_ = 0xFFFFFFFFU;
  bool valid_ = true;
};

/// Either of them, chosen when the program runs: code that is to be small has a model once for both.
class EitherCoder {
 public:
  explicit EitherCoder(RangeEncoder& encoder) : decodes(false), encoder_(&encoder) {}
  explicit EitherCoder(RangeDecoder& decoder) : decodes(true), decoder_(&decoder) {}

  const bool decodes;

  int bit(std::uint32_t probability, int value) {
    return decodes ? decoder_->bit(probability) : encoder_->bit(probability, value);
  }
  std::uint64_t bits(unsigned count, std::uint64_t value) {
    return decodes ? decoder_->bits(count) : encoder_->bits(count, value);
  }

 private:
  RangeEncoder* encoder_ = nullptr;
  RangeDecoder* decoder_ = nullptr;
};

}  // namespace semblante

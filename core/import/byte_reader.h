#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

namespace semblante::import {

/// Reads numbers of a given byte order. Reading past the end returns zero and permanently clears ok().
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes, std::endian order = std::endian::little)
      : bytes_(bytes), order_(order) {}

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::size_t position() const { return at_; }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

  template <class T>
  T read() {
    std::array<std::uint8_t, sizeof(T)> raw{};
    if (left() < sizeof(T)) {
      ok_ = false;
      at_ = bytes_.size();
      return T{};
    }
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      raw[order_ == std::endian::native ? i : sizeof(T) - 1 - i] = bytes_[at_ + i];
    }
    at_ += sizeof(T);
    return std::bit_cast<T>(raw);
  }

  void skip(std::size_t count) {
    if (left() < count) ok_ = false;
    at_ += std::min(count, left());
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::endian order_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace semblante::import

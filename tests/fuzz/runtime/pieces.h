#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

/// Cuts an input into numbers and pieces; zeros and empty pieces after its end.
class Pieces {
 public:
  Pieces(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}
  [[nodiscard]] bool is_empty() const { return rest_.empty(); }
  std::uint8_t byte() {
    const auto piece = bytes(1);
    return piece.empty() ? std::uint8_t{0} : piece[0];
  }
  std::uint16_t word() {
    const std::uint16_t low = byte();
    return static_cast<std::uint16_t>(low | byte() << 8U);
  }
  std::span<const std::uint8_t> bytes(std::size_t count) {
    const auto piece = rest_.first(std::min(count, rest_.size()));
    rest_ = rest_.subspan(piece.size());
    return piece;
  }
  std::span<const std::uint8_t> rest() { return bytes(rest_.size()); }

 private:
  std::span<const std::uint8_t> rest_;
};

inline void must(bool holds) {
  if (!holds) std::abort();
}
template <class Numbers>
void must_be_finite(const Numbers& numbers) {
  for (const auto number : numbers) must(std::isfinite(number));
}

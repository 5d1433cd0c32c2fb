#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

namespace semblante {

/// A hash of numbers that came from outside, for unordered containers. Its seed is drawn once per process, so that
/// nobody can choose numbers that all fall into one bucket and make each search linear. Nothing that is written or
/// answered may depend on it, nor on the order of a container that uses it.
class SeededHash {
 public:
  std::size_t operator()(std::uint64_t value) const { return static_cast<std::size_t>(mixed(seed() ^ value)); }

  /// Of several numbers, in order.
  template <class... Numbers>
  static std::size_t of(Numbers... numbers) {
    std::uint64_t hash = seed();
    ((hash = mixed(hash ^ static_cast<std::uint64_t>(numbers)) + seed()), ...);
    return static_cast<std::size_t>(hash);
  }

 private:
  static std::uint64_t seed() {
    static const std::uint64_t value = [] {
      std::random_device device;
      return std::uint64_t{device()} << 32U | device();
    }();
    return value;
  }
  /// Between the rounds the seed is added, so that values which meet under one seed do not meet under another.
  static std::uint64_t mixed(std::uint64_t value) {
    value = (value ^ value >> 30U) * 0xBF58476D1CE4E5B9U + seed();
    value = (value ^ value >> 27U) * 0x94D049BB133111EBU + seed();
    return value ^ value >> 31U;
  }
};

}  // namespace semblante

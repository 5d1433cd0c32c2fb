#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

namespace semblante {

/// A hash of untrusted numbers for unordered containers. Its seed is random per process, so that an attacker cannot
/// choose colliding numbers, which would make each search linear. No output may depend on the hash or on the order of
/// a container that uses it.
class SeededHash {
 public:
  std::size_t operator()(std::uint64_t value) const { return static_cast<std::size_t>(mixed(seed() ^ value)); }

  /// Hash of several numbers; depends on their order.
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
  /// Adds the seed between the rounds, so that values that collide for one seed do not collide for another.
  static std::uint64_t mixed(std::uint64_t value) {
    value = (value ^ value >> 30U) * 0xBF58476D1CE4E5B9U + seed();
    value = (value ^ value >> 27U) * 0x94D049BB133111EBU + seed();
    return value ^ value >> 31U;
  }
};

}  // namespace semblante

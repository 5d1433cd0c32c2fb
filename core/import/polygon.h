#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace semblante::import {

/// Splits polygons into triangles: quads always as (0 1 2) (0 2 3), larger ones as the fan from the first corner
/// wherever that turns no triangle over, which is what other programs do and so keeps our edges theirs; by ear clipping
/// otherwise.
class Triangulator {
 public:
  /// Corner numbers 0..n-1 by three, n - 2 triangles in the polygon's winding. `corners`: #n positions, n >= 3. The
  /// result lives until the next call.
  std::span<const std::array<std::uint32_t, 3>> split(std::span<const glm::vec3> corners);

 private:
  /// False when there is no ear left, or the work would be too much.
  bool clip_ears(std::span<const glm::vec3> corners, const glm::dvec3& normal);
  bool clip_ears(std::span<const glm::vec3> corners, const glm::dvec3& normal, std::uint64_t& left);

  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::uint32_t> ring_;
  /// Ear clipping is cubic at worst. A polygon may spend 1000 tests a corner on it, enough for any of 1000 corners that
  /// can be clipped by its square, and a file 200 million in all; what would take more gets a fan.
  static constexpr std::uint64_t tests_per_corner = 1000;
  std::uint64_t tests_left_ = 200'000'000;
};

}  // namespace semblante::import

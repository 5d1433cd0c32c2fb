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
  bool clip_ears(std::span<const glm::vec3> corners, const glm::dvec3& normal);

  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::uint32_t> ring_;
  /// Ear clipping is cubic at worst. A file may spend this much on it in all; what is left over gets fans.
  std::uint64_t tests_left_ = 200'000'000;
};

}  // namespace semblante::import

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace semblante::import {

/// Splits polygons into triangles: quads always as (0 1 2) (0 2 3), larger ones as the fan from the first corner if
/// that flips no triangle (as in other programs, so that the edges are the same), else by ear clipping.
class Triangulator {
 public:
  /// n - 2 triangles of corner numbers 0..n-1, in the polygon's winding. `corners`: #n positions, n >= 3. The result is
  /// valid until the next call.
  std::span<const std::array<std::uint32_t, 3>> split(std::span<const glm::vec3> corners);

 private:
  /// False when there is no ear left, or the effort limit is reached.
  bool clip_ears(std::span<const glm::vec3> corners, const glm::dvec3& normal);
  bool clip_ears(std::span<const glm::vec3> corners, const glm::dvec3& normal, std::uint64_t& left);

  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::uint32_t> ring_;
  /// Ear clipping is cubic in the worst case. Effort limit: 1000 tests per corner of a polygon (enough for 1000 corners
  /// in quadratic time), and 200 million per file; beyond it polygons are split as fans.
  static constexpr std::uint64_t tests_per_corner = 1000;
  std::uint64_t tests_left_ = 200'000'000;
};

}  // namespace semblante::import

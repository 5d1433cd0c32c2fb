#include "tests/support/fold_over.h"

#include <glm/geometric.hpp>

namespace semblante::bench {
namespace {

/// Twice the area below this share of the longest edge squared: a sliver.
constexpr double least_shape = 1e-4;

struct Corners {
  glm::dvec3 normal;  ///< twice the area long
  bool sliver;
};

Corners corners_of(const Triangle& t, std::span<const glm::vec3> positions) {
  const glm::dvec3 a(positions[t[0]]);
  const glm::dvec3 ab = glm::dvec3(positions[t[1]]) - a;
  const glm::dvec3 ac = glm::dvec3(positions[t[2]]) - a;
  const glm::dvec3 normal = glm::cross(ab, ac);
  const double longest = glm::max(glm::dot(ab, ab), glm::max(glm::dot(ac, ac), glm::dot(ac - ab, ac - ab)));
  return {normal, glm::length(normal) <= least_shape * longest};
}

}  // namespace

FoldOver& FoldOver::operator+=(const FoldOver& other) {
  inverted += other.inverted;
  degenerate += other.degenerate;
  inverted_area += other.inverted_area;
  return *this;
}

FoldOver count_fold_over(std::span<const Triangle> triangles, std::span<const glm::vec3> rest,
                         std::span<const glm::vec3> moved) {
  FoldOver result;
  for (const Triangle& t : triangles) {
    const Corners before = corners_of(t, rest);
    const Corners after = corners_of(t, moved);
    if (before.sliver || after.sliver) {
      ++result.degenerate;
    } else if (glm::dot(before.normal, after.normal) < 0.0) {
      ++result.inverted;
      result.inverted_area += glm::length(after.normal) / 2.0;
    }
  }
  return result;
}

}  // namespace semblante::bench

#include "core/geometry/nearest_point.h"

#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace semblante {
namespace {

TEST(NearestPoint, RandomPoints_EqualTheScan) {
  std::mt19937 random(7);
  // Coarse coordinates: plenty of equal points and equal distances, where the lowest index must win.
  std::uniform_int_distribution<int> coordinate(0, 9);
  const auto draw = [&] { return glm::dvec3(coordinate(random), coordinate(random), coordinate(random)); };
  for (const std::size_t count : {1U, 2U, 3U, 50U, 1000U}) {
    std::vector<glm::dvec3> points(count);
    for (glm::dvec3& p : points) p = draw();
    NearestPoint tree(points);
    for (int query = 0; query < 300; ++query) {
      const glm::dvec3 to = draw() + glm::dvec3(0.5, 0.0, 0.25);
      std::uint32_t expected = 0;
      for (std::uint32_t i = 1; i < points.size(); ++i) {
        if (glm::dot(points[i] - to, points[i] - to) < glm::dot(points[expected] - to, points[expected] - to)) {
          expected = i;
        }
      }
      const NearestPoint::Hit hit = tree.nearest(to);
      ASSERT_EQ(hit.index, expected);
      ASSERT_DOUBLE_EQ(hit.distance, glm::distance(points[expected], to));
      ASSERT_FALSE(tree.has_within(to, 0.999 * hit.distance));
      ASSERT_TRUE(tree.has_within(to, 1.001 * hit.distance));
      std::vector<std::uint32_t> ties;
      for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (glm::distance(points[i], to) <= hit.distance * (1.0 + 1e-9)) ties.push_back(i);
      }
      ASSERT_EQ(tree.nearest_with_ties(to), ties);
      ASSERT_EQ(tree.nearest_with_ties(to, 1.001 * hit.distance), ties);
      ASSERT_TRUE(tree.nearest_with_ties(to, 0.999 * hit.distance).empty());
    }
  }
}

TEST(NearestPoint, Tie_BeyondTheBoundOfTheNearest_IsFound) {
  const std::vector<glm::dvec3> points{{1.0 + 5e-7, 0.0, 0.0}, {3.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}};
  const std::vector<std::uint32_t> both{0, 2};
  EXPECT_EQ(NearestPoint(points).nearest_with_ties({0.0, 0.0, 0.0}, 1.0 + 1e-9), both);
}

}  // namespace
}  // namespace semblante

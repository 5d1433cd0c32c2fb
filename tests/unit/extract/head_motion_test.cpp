#include "core/extract/head_motion.h"

#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace semblante {
namespace {

std::vector<glm::vec3> cloud(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-10.0F, 10.0F);
  std::vector<glm::vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = place(random), y = place(random), z = place(random);
    points.emplace_back(x, y, z);
  }
  return points;
}

TEST(HeadMotion, OfAHeadThatKeepsStillIsNothing) {
  const auto points = cloud(100, 1);
  const auto motion = find_head_motion(points, points);
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->degrees(), 0.0, 1e-5);
  EXPECT_LT(glm::length(motion->still - motion->moved), 1e-12);
}

// A quarter turn about z, and two fifths of the vertices pulled away to one side.
TEST(HeadMotion, IsThatOfTheHalfThatKeepsItsShape) {
  const auto points = cloud(1000, 2);
  std::vector<glm::vec3> moved;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec3& p = points[i];
    moved.emplace_back(-p.y + 4.0F, p.x, p.z - 1.0F);
    if (i % 5 < 2) moved.back() += glm::vec3(3, 1, 0);
  }
  const auto motion = find_head_motion(points, moved);
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->degrees(), 90.0, 1e-4);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % 5 < 2) continue;
    EXPECT_LT(glm::distance(motion->undo(moved[i]), glm::dvec3(points[i])), 1e-4);
  }
}

// Sampled: far more vertices than are looked at.
TEST(HeadMotion, OfManyVerticesIsTheSame) {
  const auto points = cloud(50'000, 3);
  std::vector<glm::vec3> moved;
  for (const glm::vec3& p : points) moved.push_back(p + glm::vec3(0, 2, 0));
  const auto motion = find_head_motion(points, moved);
  ASSERT_TRUE(motion);
  EXPECT_LT(glm::distance(motion->undo({1, 2, 3}), glm::dvec3(1, 0, 3)), 1e-5);
}

TEST(HeadMotion, NeedsVerticesThatSpanASpace) {
  EXPECT_FALSE(find_head_motion(cloud(7, 4), cloud(7, 4)));
  std::vector<glm::vec3> line;
  for (int i = 0; i < 20; ++i) line.emplace_back(static_cast<float>(i), 0.0F, 0.0F);
  EXPECT_FALSE(find_head_motion(line, line));
}

}  // namespace
}  // namespace semblante

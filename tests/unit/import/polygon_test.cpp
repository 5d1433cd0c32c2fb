#include "core/import/polygon.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace semblante::import {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Triangles split(const std::vector<glm::vec3>& corners) {
  Triangulator triangulator;
  const auto triangles = triangulator.split(corners);
  return {triangles.begin(), triangles.end()};
}

/// Twice the signed area of each triangle seen from +Z.
std::vector<float> areas(const std::vector<glm::vec3>& corners, const Triangles& triangles) {
  std::vector<float> all;
  for (const auto& [a, b, c] : triangles) {
    all.push_back(glm::cross(corners[b] - corners[a], corners[c] - corners[a]).z);
  }
  return all;
}

TEST(Polygon, ConvexQuad_IsAFanFromItsFirstCorner) {
  EXPECT_EQ(split({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Polygon, ConcaveQuad_IsAFanToo_SinceItsDiagonalIsAnEdgeOthersMustFind) {
  // An arrow head whose notch is corner 1: the fan turns (0, 1, 2) over, and stays.
  EXPECT_EQ(split({{-1, -1, 0}, {0, 0, 0}, {1, -1, 0}, {0, 2, 0}}), (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Polygon, ConcavePentagon_IsCutAtItsNotch) {
  // A house seen upside down: the notch is corner 1, so a fan from corner 0 would leave the polygon.
  const std::vector<glm::vec3> house = {{-1, -1, 0}, {0, 0, 0}, {1, -1, 0}, {1, 2, 0}, {-1, 2, 0}};
  const Triangles triangles = split(house);
  ASSERT_EQ(triangles.size(), 3U);
  for (const float area : areas(house, triangles)) EXPECT_GT(area, 0.0F);
}

TEST(Polygon, Comb_IsCoveredOnce_WithoutTurningOver) {
  // A base with three teeth: many notches. The sum of positive areas equals the polygon's area only if no two overlap.
  const std::vector<glm::vec3> comb = {{0, 0, 0}, {6, 0, 0}, {6, 4, 0}, {5, 1, 0}, {4, 4, 0},
                                       {3, 1, 0}, {2, 4, 0}, {1, 1, 0}, {0, 4, 0}};
  float twice_area = 0.0F;
  for (std::size_t i = 0; i < comb.size(); ++i) {
    const glm::vec3& p = comb[i];
    const glm::vec3& q = comb[(i + 1) % comb.size()];
    twice_area += p.x * q.y - q.x * p.y;
  }
  const Triangles triangles = split(comb);
  EXPECT_EQ(triangles.size(), comb.size() - 2);
  float sum = 0.0F;
  for (const float area : areas(comb, triangles)) {
    EXPECT_GE(area, 0.0F);
    sum += area;
  }
  EXPECT_FLOAT_EQ(sum, twice_area);
}

TEST(Polygon, Bowtie_ThatCrossesItself_StillGivesAllTriangles) {
  EXPECT_EQ(split({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 2, 0}}).size(), 2U);
}

TEST(Polygon, CornersInOnePoint_StillGiveAllTriangles) {
  EXPECT_EQ(split(std::vector<glm::vec3>(7, glm::vec3(1.0F))).size(), 5U);
}

TEST(Polygon, HugeJaggedPolygon_CostsABoundedAmountOfWork) {
  std::vector<glm::vec3> saw;
  for (int i = 0; i < 200'000; ++i) saw.emplace_back(static_cast<float>(i), i % 2 == 0 ? 0.0F : -1.0F, 0.0F);
  saw.emplace_back(200'000.0F, 100.0F, 0.0F);
  saw.emplace_back(0.0F, 100.0F, 0.0F);
  EXPECT_EQ(split(saw).size(), saw.size() - 2);
}

}  // namespace
}  // namespace semblante::import

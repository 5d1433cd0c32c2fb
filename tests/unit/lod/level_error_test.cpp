#include "core/lod/level_error.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/geometry/triangle_tree.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

/// A level by hand: the grid's outer corners alone.
LevelOfDetail two_triangles(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  LevelOfDetail level;
  level.triangles = {{a, b, c}, {a, c, d}};
  level.source_triangles = {0, 1};
  level.vertex_count = 4;
  return level;
}

TEST(LevelError, IsTheDistanceToTheCoarseSurface) {
  Model model = testing::make_grid(10, 10);
  const Surface surface = build_surface(model);
  const LevelOfDetail level = two_triangles(0, 10, 120, 110);
  EXPECT_NEAR(measure_level(model, surface, level, {}).neutral.max, 0.0, 1e-12);

  model.positions[5 * 11 + 5].z = 3.0F;
  model.positions[3 * 11 + 2].z = -1.0F;
  const std::vector<LodPose> poses = {{"flat", testing::make_grid(10, 10).positions}, {"bumps", model.positions}};
  const LevelError error = measure_level(model, surface, level, poses);
  EXPECT_DOUBLE_EQ(error.neutral.max, 3.0);
  EXPECT_NEAR(error.neutral.mean, 4.0 / 121.0, 1e-12);
  EXPECT_NEAR(error.neutral.rms, std::sqrt(10.0 / 121.0), 1e-12);
  EXPECT_NEAR(error.poses[0].max, 0.0, 1e-12);
  EXPECT_DOUBLE_EQ(error.poses[1].rms, error.neutral.rms);
}

TEST(LevelError, CountsTrianglesAndTexturesThatTurnedOver) {
  Model model = testing::make_grid(4, 4);
  for (const glm::vec3& p : model.positions) model.uvs.emplace_back(p.x, p.y);
  model.uv_triangles = model.triangles;
  const Surface surface = build_surface(model);
  LevelOfDetail level = two_triangles(0, 4, 24, 20);
  level.uv_triangles = level.triangles;
  EXPECT_EQ(measure_level(model, surface, level, {}).flipped_triangles, 0U);
  EXPECT_NEAR(measure_level(model, surface, level, {}).uv_max, 0.0, 1e-6);
  std::swap(level.uv_triangles[1][1], level.uv_triangles[1][2]);
  EXPECT_EQ(measure_level(model, surface, level, {}).flipped_uvs, 1U);
  EXPECT_GT(measure_level(model, surface, level, {}).uv_max, 0.5);
  std::swap(level.triangles[0][0], level.triangles[0][1]);
  EXPECT_EQ(measure_level(model, surface, level, {}).flipped_triangles, 1U);
}

TEST(LevelError, LooksAtTheSamePartOnly) {
  // A plate just under another: the lower one's own level is far from it.
  Model model = testing::make_grid(4, 4);
  Model lower = testing::shifted(testing::make_grid(4, 4), {0.0F, 0.0F, -0.1F});
  lower.positions[2 * 5 + 2].z = 5.0F;
  testing::append(model, lower, "lower");
  const Surface surface = build_surface(model);
  LevelOfDetail level = two_triangles(0, 4, 24, 20);
  level.triangles.insert(level.triangles.end(), {{25, 29, 49}, {25, 49, 45}});
  level.source_triangles = {0, 1, 32, 33};
  EXPECT_NEAR(measure_level(model, surface, level, {}).neutral.max, 5.1, 1e-6);
}

TEST(TriangleTree, FindsWhatTryingAllFinds) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-1.0F, 1.0F);
  std::vector<glm::vec3> positions(300);
  const auto scatter = [&] {
    for (glm::vec3& p : positions) p = {place(random), place(random), place(random)};
  };
  scatter();
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i + 2 < positions.size(); ++i) triangles.push_back({i, i + 1, i + 2});
  triangles.push_back({5, 5, 5});
  TriangleTree tree(positions, triangles);
  for (int round = 0; round < 2; ++round) {
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 to(1.5 * place(random), 1.5 * place(random), 1.5 * place(random));
      double least = std::numeric_limits<double>::infinity();
      for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (t % 3 == 0) continue;
        const TriangleTree alone(positions, std::span(triangles).subspan(t, 1));
        least = std::min(least, alone.nearest(to, [](std::uint32_t) { return true; }).distance);
      }
      const auto hit = tree.nearest(to, [](std::uint32_t t) { return t % 3 != 0; });
      EXPECT_DOUBLE_EQ(hit.distance, least);
    }
    scatter();
    tree.move_to(positions);
  }
}

TEST(TriangleTree, KnowsCornersEdgesAndInsides) {
  const std::vector<glm::vec3> positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  const TriangleTree tree(positions, triangles);
  const auto distance = [&](glm::dvec3 p) { return tree.nearest(p, [](std::uint32_t) { return true; }).distance; };
  EXPECT_DOUBLE_EQ(distance({1, 1, 2}), 2.0);
  EXPECT_DOUBLE_EQ(distance({-3, -4, 0}), 5.0);
  EXPECT_DOUBLE_EQ(distance({2, -3, 0}), 3.0);
  EXPECT_DOUBLE_EQ(distance({4, 4, 0}), std::sqrt(8.0));
  EXPECT_DOUBLE_EQ(distance({7, 0, 4}), 5.0);
  EXPECT_TRUE(std::isinf(tree.nearest({0, 0, 0}, [](std::uint32_t) { return false; }).distance));
}

}  // namespace
}  // namespace semblante

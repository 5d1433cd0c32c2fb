// Normals of the vertices that a level keeps.
#include "core/lod/level_normals.h"

#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace semblante {
namespace {

TEST(LevelNormals, OfTheFullMesh_WhereTheyAreLikeTheirSurroundings) {
  const glm::dvec3 own = glm::normalize(glm::dvec3(0.3, 0.0, 1.0));
  const CornerNormals full{{own, {0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}}, {1.0, 5.0, 5.0}};
  const auto normals = level_normals(full, std::array<std::uint32_t, 3>{0, 0, 0});
  EXPECT_EQ(normals[0], glm::vec3(own));
}

TEST(LevelNormals, MeanOfTheSurroundings_WhereOneFacesElsewhere) {
  // As at the corner of a mouth: the vertex of the fold, the skin outside, and both sides of what is behind the lips.
  const CornerNormals full{{{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {0.2, 0.0, 1.0}, {0.0, -1.0, 0.0}, {0.0, 0.9, -0.3}},
                           {0.1, 4.0, 4.0, 3.0, 3.0}};
  const auto normals = level_normals(full, std::array<std::uint32_t, 5>{0, 0, 0, 0, 0});
  EXPECT_GT(normals[0].z, 0.97F);
  EXPECT_NEAR(glm::length(normals[0]), 1.0F, 1e-6F);
}

TEST(LevelNormals, NothingElse_IsItself) {
  const CornerNormals full{{{0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}}, {0.0, 2.0}};
  const auto normals = level_normals(full, std::array<std::uint32_t, 2>{0, 1});
  EXPECT_EQ(normals[0], glm::vec3(0.0F, 1.0F, 0.0F)) << "without area";
  EXPECT_EQ(normals[1], glm::vec3(0.0F, -1.0F, 0.0F));
}

}  // namespace
}  // namespace semblante

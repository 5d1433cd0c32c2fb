#include "core/anatomy/pivots.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

Part part_of(const Model& model, PartRole role) {
  Part part;
  part.role = role;
  part.vertex_count = static_cast<std::uint32_t>(model.positions.size());
  part.box_min = part.box_max = model.positions.front();
  for (const glm::vec3& p : model.positions) {
    part.box_min = glm::min(part.box_min, p);
    part.box_max = glm::max(part.box_max, p);
  }
  return part;
}

FeaturePoint bare(std::string_view name, const glm::vec3& position) {
  return {testing::fp(name), std::nullopt, position};
}

const FeaturePointSet pupils = {bare("3.5", {3, 4, 9}), bare("3.6", {-3, 4, 9})};

glm::vec3 pivot_of(const Model& eye) {
  return eye_pivot(build_surface(eye), std::vector{part_of(eye, PartRole::left_eye)}, PartRole::left_eye, pupils);
}

TEST(EyePivot, Ball_TurnsAboutItsCenter) {
  EXPECT_LT(glm::distance(pivot_of(testing::make_ball({3, 4, 8}, 1.2F)), glm::vec3(3, 4, 8)), 1e-4F);
}

TEST(EyePivot, FrontHalfOfABall_TurnsAboutTheCenterOfTheWhole) {
  Model half = testing::make_ball({3, 4, 8}, 1.2F, 32, 16);
  std::erase_if(half.triangles, [&](const Triangle& t) {
    return half.positions[t[0]].z < 8 || half.positions[t[1]].z < 8 || half.positions[t[2]].z < 8;
  });
  for (glm::vec3& p : half.positions) p.z = std::max(p.z, 8.0F);
  std::vector<glm::vec3> kept;
  Model front;
  std::vector<std::uint32_t> renumbered(half.positions.size(), Model::no_index);
  for (Triangle t : half.triangles) {
    for (std::uint32_t& corner : t) {
      if (renumbered[corner] == Model::no_index) {
        renumbered[corner] = static_cast<std::uint32_t>(front.positions.size());
        front.positions.push_back(half.positions[corner]);
      }
      corner = renumbered[corner];
    }
    front.triangles.push_back(t);
  }
  EXPECT_LT(glm::distance(pivot_of(front), glm::vec3(3, 4, 8)), 1e-3F);
}

TEST(EyePivot, BulgingCornea_DoesNotPullItForward) {
  Model eye = testing::make_ball({3, 4, 8}, 1.2F, 32, 32);
  for (glm::vec3& p : eye.positions) {
    if (p.z > 9.1F) p.z += 0.15F;
  }
  EXPECT_LT(glm::distance(pivot_of(eye), glm::vec3(3, 4, 8)), 0.01F);
}

TEST(EyePivot, FlatIris_TurnsAboutAPointBehindIt) {
  Model iris = testing::make_grid(2, 2);
  for (glm::vec3& p : iris.positions) p += glm::vec3(2, 3, 9);
  // Pupils 6 apart: 0.2 ES0 = 1.2 behind the middle of the disc.
  EXPECT_LT(glm::distance(pivot_of(iris), glm::vec3(3, 4, 7.8F)), 1e-5F);
}

TEST(EyePivot, NeitherBallNorDisc_TurnsAboutItsBox) {
  EXPECT_LT(glm::distance(pivot_of(testing::make_box({2, 3, 7}, {4, 5, 11})), glm::vec3(3, 4, 9)), 1e-5F);
}

TEST(EyePivot, NoPart_IsBehindThePupil) {
  const Model skin = testing::make_grid(2, 2);
  const auto pivot =
      eye_pivot(build_surface(skin), std::vector{part_of(skin, PartRole::skin)}, PartRole::right_eye, pupils);
  EXPECT_LT(glm::distance(pivot, glm::vec3(-3, 4, 7.8F)), 1e-5F);
}

// As on cartoons: a lid that lies behind the axis on which it rolls would cave in.
TEST(EyePivot, NoPart_IsBehindTheCornersOfLidsThatWrapAroundTheEye) {
  const Model skin = testing::make_grid(2, 2);
  const auto pivot_with_corner_at = [&](float depth) {
    FeaturePointSet points = pupils;
    points.push_back(bare("3.8", {-2, 4, 8.9F}));
    points.push_back(bare("3.12", {-5, 4, 9 - depth}));
    return eye_pivot(build_surface(skin), std::vector{part_of(skin, PartRole::skin)}, PartRole::right_eye, points);
  };
  EXPECT_LT(glm::distance(pivot_with_corner_at(0.7F), glm::vec3(-3, 4, 7.8F)), 1e-5F) << "as on people";
  // 0.05 ES0 = 0.3 behind the corner.
  EXPECT_LT(glm::distance(pivot_with_corner_at(1.8F), glm::vec3(-3, 4, 6.9F)), 1e-5F);
}

TEST(HeadPivot, Marked_IsThatPoint) {
  FeaturePointSet points = pupils;
  points.push_back(bare("7.1", {0, -1, 0.5F}));
  EXPECT_EQ(head_pivot({}, points), glm::vec3(0, -1, 0.5F));
  EXPECT_EQ(head_pivot({}, points, {{}, SkinJoint{"Head", {0, 2, 3}}}), glm::vec3(0, -1, 0.5F)) << "marked by hand";
}

TEST(HeadPivot, NotMarked_IsEstimatedFromTheEyes) {
  // ES0 = 6: 0.74 * 6 = 4.44 below the eyes' middle (0, 4, 9), 1.6 * 6 = 9.6 behind it.
  EXPECT_EQ(head_pivot({}, pupils, {{}, SkinJoint{"Head", {0, 2, 3}}}), glm::vec3(0, 2, 3));
  EXPECT_LT(glm::distance(head_pivot({}, pupils), glm::vec3(0, -0.44F, -0.6F)), 1e-5F);
}

TEST(HeadPivot, NothingMarked_IsEstimatedFromTheSkin) {
  const Part skin = part_of(testing::make_box({-10, -20, -10}, {10, 20, 10}), PartRole::skin);
  // (0.5, 0.45, 0.4) of the box.
  EXPECT_LT(glm::distance(head_pivot(std::vector{skin}, {}), glm::vec3(0, -2, -2)), 1e-5F);
  EXPECT_EQ(head_pivot({}, {}), glm::vec3(0));
}

}  // namespace
}  // namespace semblante

#include "core/expressions/companions.h"

#include <algorithm>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/expressions/contact.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

/// A left eye ten wide and a fold `below` above the edge of its lid, with a brow `above` it.
FeaturePointSet eye(float above, float below) {
  return {{testing::fp("3.1"), VertexId(0), {5.0F, 0.0F, 0.0F}},
          {testing::fp("3.7"), VertexId(0), {10.0F, 0.0F, 0.0F}},
          {testing::fp("3.11"), VertexId(0), {0.0F, 0.0F, 0.0F}},
          {testing::fp("3.13"), VertexId(0), {5.0F, below, 0.0F}},
          {testing::fp("4.3"), VertexId(0), {5.0F, below + above, 0.0F}}};
}

/// The share of the brow that the fold follows; 0 without an entry.
float share_of(const FeaturePointSet& points) {
  const auto companions = companions_of(points);
  const auto at = std::find_if(companions.begin(), companions.end(), [](const Companion& c) {
    return c.point == testing::fp("3.13") && c.leader == testing::fp("4.3");
  });
  return at != companions.end() ? at->share : 0.0F;
}

TEST(FoldsBelowNearBrows, StayBelowABrowHalfAnEyeAboveThem) {
  EXPECT_EQ(share_of(eye(5.0F, 2.0F)), 0.0F);
  EXPECT_NEAR(share_of(eye(4.9F, 2.0F)), 0.02F, 1e-6F);
}

// A brow that goes down by d leaves the skin (1 - share) d narrower: 2 d / (eye's width) of it, as with a far brow.
TEST(FoldsBelowNearBrows, KeepTheSkinBelowTheBrowAsWideAsWithAFarOne) {
  EXPECT_NEAR(share_of(eye(4.0F, 4.0F)), 0.2F, 1e-6F);
  EXPECT_NEAR(share_of(eye(3.0F, 3.0F)), 0.4F, 1e-6F);
}

TEST(FoldsBelowNearBrows, SqueezeTheLidNoMoreThanTheSkinAbove) { EXPECT_NEAR(share_of(eye(3.0F, 1.0F)), 0.25F, 1e-6F); }

TEST(FoldsBelowNearBrows, NeedAllPointsOfTheEye) {
  for (std::size_t left_out = 0; left_out < 5; ++left_out) {
    FeaturePointSet points = eye(3.0F, 3.0F);
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(left_out));
    EXPECT_EQ(share_of(points), 0.0F);
  }
}

float fold_after(float fold, float brow) {
  std::vector<Displacement> displacements = {{testing::fp("3.13"), {0.5F, fold, 0.0F}},
                                             {testing::fp("4.3"), {0.0F, brow, 0.0F}}};
  follow_near_brows(displacements, eye(3.0F, 3.0F));
  EXPECT_EQ(displacements[0].value.x, 0.5F);
  EXPECT_EQ(displacements[1].value.y, brow);
  return displacements[0].value.y;
}

TEST(FollowNearBrows, MovesAFoldThatStaysBehind) {
  EXPECT_FLOAT_EQ(fold_after(-0.1F, -1.0F), -0.4F);
  EXPECT_FLOAT_EQ(fold_after(0.1F, 1.0F), 0.4F);
}

TEST(FollowNearBrows, LeavesAFoldThatGoesFartherOrItsOwnWay) {
  EXPECT_EQ(fold_after(-0.5F, -1.0F), -0.5F);
  EXPECT_EQ(fold_after(-0.1F, 1.0F), -0.1F);
  EXPECT_EQ(fold_after(0.1F, -1.0F), 0.1F);
}

// What was measured on a face, or made by a user, is worn as it is.
TEST(FollowNearBrows, IsOfTheLibraryAlone) {
  const std::vector<Displacement> displacements = {{testing::fp("3.13"), {0.0F, -0.1F, 0.0F}},
                                                   {testing::fp("4.3"), {0.0F, -1.0F, 0.0F}}};
  Fapu fapu;
  fapu.value = {1.0, 1.25, 1.0, 0.5, 1.0};
  DisplacementSet set{"anger", displacements};
  EXPECT_FLOAT_EQ(on_face(set, fapu, eye(3.0F, 3.0F)).displacements[0].value.y, -0.1F);
  set.of_library = true;
  EXPECT_FLOAT_EQ(on_face(set, fapu, eye(3.0F, 3.0F)).displacements[0].value.y, -0.4F);
  for (const DisplacementSet& expression : expression_library()) EXPECT_TRUE(expression.of_library) << expression.name;
}

/// A mouth six wide, and a cheek `beside` the left corner.
FeaturePointSet cheek(float beside) {
  return {{testing::fp("5.1"), VertexId(0), {3.0F, 0.0F, -beside}},
          {testing::fp("8.3"), VertexId(0), {3.0F, 0.0F, 0.0F}},
          {testing::fp("8.4"), VertexId(0), {-3.0F, 0.0F, 0.0F}}};
}

/// The shares of the corner that the cheek follows, by the table and beside a near corner, in sum.
float share_of_corner(const FeaturePointSet& points) {
  float share = 0.0F;
  for (const Companion& c : companions_of(points))
    share += c.point == testing::fp("5.1") && c.leader == testing::fp("8.3") ? c.share : 0.0F;
  return share;
}

TEST(CheeksBesideNearCorners, FollowWhatTheTableLeaves_TheMoreTheNearer) {
  const float far = share_of_corner(cheek(2.0F));
  ASSERT_GT(far, 0.0F);
  EXPECT_NEAR(share_of_corner(cheek(1.0F)), far + 0.5F * (1.0F - far), 1e-6F);
  EXPECT_NEAR(share_of_corner(cheek(0.0F)), 1.0F, 1e-6F);
}

TEST(CheeksBesideNearCorners, NeedBothCorners) {
  FeaturePointSet points = cheek(1.0F);
  points.pop_back();
  EXPECT_TRUE(cheeks_beside_near_corners(points).empty());
}

// Of the difference of their displacements as much is left as of the distance: the skin between them is stretched as
// beside a far corner.
TEST(FollowNearCorners, MovesACheekTowardsTheCornersDisplacement) {
  const auto cheek_after = [](float beside) {
    std::vector<Displacement> displacements = {{testing::fp("5.1"), {0.0F, 1.0F, 2.0F}},
                                               {testing::fp("8.3"), {4.0F, 5.0F, -2.0F}}};
    follow_near_corners(displacements, cheek(beside));
    EXPECT_EQ(displacements[1].value, glm::vec3(4.0F, 5.0F, -2.0F));
    return displacements[0].value;
  };
  EXPECT_EQ(cheek_after(2.0F), glm::vec3(0.0F, 1.0F, 2.0F));
  EXPECT_NEAR(glm::distance(cheek_after(0.5F), glm::vec3(3.0F, 4.0F, -1.0F)), 0.0F, 1e-6F);
}

TEST(FollowNearCorners, IsOfTheLibraryAlone) {
  const std::vector<Displacement> displacements = {{testing::fp("5.1"), {0.0F, 0.0F, 0.0F}},
                                                   {testing::fp("8.3"), {0.0F, 1.0F, 0.0F}}};
  Fapu fapu;
  fapu.value = {1.0, 1.25, 1.0, 1.0, 2.0};
  DisplacementSet set{"joy", displacements};
  EXPECT_EQ(on_face(set, fapu, cheek(0.5F)).displacements[0].value.y, 0.0F);
  set.of_library = true;
  EXPECT_FLOAT_EQ(on_face(set, fapu, cheek(0.5F)).displacements[0].value.y, 0.75F);
}

float share_between(const FeaturePointSet& points, const char* point, const char* leader) {
  float share = 0.0F;
  for (const Companion& c : companions_of(points))
    share += c.point == testing::fp(point) && c.leader == testing::fp(leader) ? c.share : 0.0F;
  return share;
}

/// A left eye ten wide and five open; the folds lie `above` and `below` its edges, the cheek bone 20 below the edge
/// or `cheek_bone`.
FeaturePointSet wide_eye(float above, float below, float cheek_bone = 20.0F) {
  return {{testing::fp("3.1"), VertexId(0), {5.0F, 5.0F, 0.0F}},
          {testing::fp("3.3"), VertexId(0), {5.0F, 0.0F, 0.0F}},
          {testing::fp("3.7"), VertexId(0), {10.0F, 2.0F, 0.0F}},
          {testing::fp("3.9"), VertexId(0), {5.0F, -below, 0.0F}},
          {testing::fp("3.11"), VertexId(0), {0.0F, 2.0F, 0.0F}},
          {testing::fp("3.13"), VertexId(0), {5.0F, 5.0F + above, 0.0F}},
          {testing::fp("5.3"), VertexId(0), {5.0F, -cheek_bone, 0.0F}}};
}

TEST(FoldsBesideNearEdges, OfPeopleFollowAsTheTableSays) {
  const float far = share_between(wide_eye(2.0F, 2.25F), "3.13", "3.1");
  ASSERT_GT(far, 0.3F);
  EXPECT_TRUE(folds_beside_near_edges(wide_eye(2.0F, 2.25F)).empty());
  EXPECT_EQ(share_between(wide_eye(2.0F, 2.25F), "3.9", "3.3"), 0.0F);
}

TEST(FoldsBesideNearEdges, FollowTheMoreTheNearer_AtTheEdgeCompletely) {
  const float far = share_between(wide_eye(2.0F, 2.25F), "3.13", "3.1");
  EXPECT_NEAR(share_between(wide_eye(1.0F, 1.125F), "3.13", "3.1"), far + 0.5F * (1.0F - far), 1e-6F);
  EXPECT_NEAR(share_between(wide_eye(1.0F, 1.125F), "3.9", "3.3"), 0.5F, 1e-6F);
  EXPECT_NEAR(share_between(wide_eye(0.0F, 0.0F), "3.13", "3.1"), 1.0F, 1e-6F);
  EXPECT_NEAR(share_between(wide_eye(0.0F, 0.0F), "3.9", "3.3"), 1.0F, 1e-6F);
}

TEST(FollowNearEdges, MovesAFoldTowardsTheEdgesDisplacement) {
  std::vector<Displacement> displacements = {{testing::fp("3.3"), {0.0F, 1.0F, 0.0F}},
                                             {testing::fp("3.9"), {0.0F, 3.0F, 0.0F}}};
  follow_near_edges(displacements, wide_eye(2.0F, 1.125F));
  EXPECT_EQ(displacements[0].value.y, 1.0F);
  EXPECT_NEAR(displacements[1].value.y, 2.0F, 1e-6F);
}

TEST(LidsAboveNearCheekBones, FollowTheMoreTheNearer_AndOnce) {
  EXPECT_TRUE(lids_above_near_cheek_bones(wide_eye(2.0F, 2.25F, 6.8F)).empty());
  EXPECT_NEAR(share_between(wide_eye(2.0F, 2.25F, 3.25F), "3.3", "5.3"), 0.5F, 1e-6F);
  // The fold is a third of its way from the edge and follows that too: its own share is what is left of 1 - 2.125
  // / 4.5.
  const FeaturePointSet near = wide_eye(2.0F, 1.125F, 3.25F);
  EXPECT_NEAR(share_between(near, "3.9", "3.3"), 0.5F, 1e-6F);
  EXPECT_NEAR(share_between(near, "3.9", "5.3"), (1.0F - 2.125F / 4.5F) - 0.5F * 0.5F, 1e-6F);
}

TEST(KeepLidsShut, StopsWhatOpensThemAlone) {
  std::vector<Displacement> displacements = {{testing::fp("3.1"), {0.0F, 1.0F, 0.0F}},
                                             {testing::fp("3.2"), {0.0F, -1.0F, 0.0F}},
                                             {testing::fp("3.3"), {0.0F, 1.0F, 0.0F}},
                                             {testing::fp("3.4"), {0.0F, -1.0F, 0.0F}},
                                             {testing::fp("2.2"), {0.0F, 1.0F, 0.0F}}};
  keep_lids_shut(displacements);
  const std::vector<float> expected = {0.0F, -1.0F, 1.0F, 0.0F, 1.0F};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(displacements[i].value.y, expected[i]) << i;
}

}  // namespace
}  // namespace semblante

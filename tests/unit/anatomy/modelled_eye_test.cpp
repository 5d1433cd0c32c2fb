#include "core/anatomy/modelled_eye.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/anatomy/joined_rims.h"
#include "core/anatomy/opening_margins.h"
#include "core/tables/openings.h"
#include "tests/support/meshes.h"
#include "tests/support/sculpted_eye.h"

namespace semblante {
namespace {

using testing::ball_behind_lids;
using testing::sculpted_edge;
using testing::sculpted_radius;
using testing::SculptedEye;

std::optional<ModelledEye> left_of(const SculptedEye& head) {
  return find_modelled_eyes(head.surface, head.model.triangles, head.parts, head.points)[0];
}

TEST(ModelledEye, BallBetweenLidsIsHeld) {
  const SculptedEye head(0.08);
  const auto eye = left_of(head);
  ASSERT_TRUE(eye.has_value());
  ASSERT_FALSE(eye->held.empty());
  for (const SurfaceVertexId v : eye->held) {
    const glm::dvec3& p = head.surface.positions[v.value()];
    EXPECT_NEAR(glm::length(p), sculpted_radius, 1e-6);
    EXPECT_LT(std::abs(p.y), sculpted_edge(p.x));
  }
  ASSERT_TRUE(eye->ball.has_value());
  EXPECT_NEAR(eye->ball->radius, sculpted_radius, 0.05 * sculpted_radius);
  EXPECT_NEAR(eye->upper.y, sculpted_edge(0.0), 0.05);
  EXPECT_NEAR(eye->lower.y, -sculpted_edge(0.0), 0.05);
}

// What lies on the edges meets: the way of the middle, by its share, is the height of the opening there.
TEST(ModelledEye, EdgesGoAsFarAsTheEyeIsOpen) {
  const SculptedEye head(0.08);
  const auto eye = left_of(head);
  ASSERT_TRUE(eye.has_value());
  EXPECT_GE(eye->rim.size(), 30U);
  const double open = eye->upper.y - eye->lower.y;
  for (const ModelledEye::RimPlace& place : eye->rim) {
    const glm::dvec3& p = head.surface.positions[place.vertex.value()];
    EXPECT_EQ(place.is_upper, p.y > 0.0) << p.x;
    EXPECT_NEAR(std::abs(p.y) - place.share * open, -sculpted_edge(p.x), 0.06) << p.x;
    EXPECT_FALSE(std::binary_search(eye->held.begin(), eye->held.end(), place.vertex));
  }
}

TEST(ModelledEye, ItsEdgesAreThePlacesOfMargins) {
  const SculptedEye head(0.08);
  const auto eye = left_of(head);
  ASSERT_TRUE(eye.has_value());
  const auto sites = margin_sites(head.surface, head.points, {eye, std::nullopt});
  ASSERT_GE(sites.size(), 30U);
  for (const MarginSite& site : sites) {
    const auto place = std::find_if(eye->rim.begin(), eye->rim.end(),
                                    [&](const ModelledEye::RimPlace& p) { return p.vertex == site.vertex; });
    ASSERT_NE(place, eye->rim.end());
    const auto middle = parse_feature_point(place->is_upper ? "3.1" : "3.3").value();
    double share = 0.0;
    for (const auto& [id, of_point] : site.shares) share += id == middle ? of_point : 0.0;
    EXPECT_DOUBLE_EQ(share, place->share);
  }
}

TEST(ModelledEye, ASheetWithoutAStepHasNone) { EXPECT_FALSE(left_of(SculptedEye(0.0)).has_value()); }

TEST(ModelledEye, APointOnTheBallLeavesItAlone) {
  SculptedEye head(0.08);
  head.mark("3.3", 0.0, -0.1);
  EXPECT_FALSE(left_of(head).has_value());
}

TEST(ModelledEye, ACornerOnTheBallLeavesItAlone) {
  SculptedEye head(0.08);
  head.mark("3.11", -0.7, 0.0);
  EXPECT_FALSE(left_of(head).has_value());
}

TEST(ModelledEye, AHeadWithAnEyeballHasNone) {
  SculptedEye head(0.08);
  head.parts.emplace_back().role = PartRole::left_eye;
  EXPECT_FALSE(left_of(head).has_value());
}

// As converters leave an eyeball that merge what is near.
TEST(ModelledEye, ABallThatGoesOnBehindTheLids_AndIsWeldedToOne_IsHeld) {
  const SculptedEye head = ball_behind_lids(true);
  ASSERT_FALSE(are_joined(head.surface, mpeg4::lids_of(0), head.points));
  const auto eye = left_of(head);
  ASSERT_TRUE(eye.has_value());
  std::size_t hidden = 0;
  for (const SurfaceVertexId v : eye->held) {
    const glm::dvec3& p = head.surface.positions[v.value()];
    EXPECT_NEAR(glm::length(p), sculpted_radius, 1e-4) << "a vertex of the lids";
    if (std::abs(p.y) > sculpted_edge(p.x)) ++hidden;
  }
  EXPECT_GT(hidden, 20U) << "the ball behind the lids would move with them";
  EXPECT_FALSE(eye->rim.empty());
  ASSERT_TRUE(eye->ball.has_value());
  EXPECT_NEAR(eye->ball->radius, sculpted_radius, 0.05 * sculpted_radius);
  EXPECT_NEAR(eye->upper.y, sculpted_edge(0.0), 0.06);
}

TEST(ModelledEye, AnOpeningBeforeNothingOfItsPartHasNone) {
  EXPECT_FALSE(left_of(ball_behind_lids(false)).has_value());
}

TEST(ModelledEye, MissingPointsFindNothing) {
  SculptedEye head(0.08);
  head.points.pop_back();
  EXPECT_FALSE(left_of(head).has_value());
}

}  // namespace
}  // namespace semblante

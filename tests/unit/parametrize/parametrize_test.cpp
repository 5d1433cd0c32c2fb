#include "core/parametrize/parametrize.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/anatomy/joined_rims.h"
#include "core/anatomy/lid_edge.h"
#include "core/parametrize/place_feature_points.h"
#include "core/tables/openings.h"
#include "tests/support/meshes.h"
#include "tests/support/sample_head_model.h"

namespace semblante {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Result<Rig> parametrize_model(const Model& model, const FeaturePointSet& points,
                              const ParametrizeOptions& options = {}) {
  return parametrize(model, build_surface(model), points, options);
}

TEST(Parametrize, NoTriangles_IsRefused) {
  Model model;
  model.positions = {{0, 0, 0}};
  const auto rig = parametrize_model(model, {});
  ASSERT_FALSE(rig);
  EXPECT_EQ(rig.error().code, ErrorCode::empty);
}

TEST(Parametrize, Cancelled_SaysSo) {
  const Model model = testing::make_strip(4);
  ParametrizeOptions options;
  options.progress = [](double, std::string_view) { return false; };
  const auto rig = parametrize_model(model, testing::points_at(model, {{"2.1", 0}}), options);
  ASSERT_FALSE(rig);
  EXPECT_EQ(rig.error().code, ErrorCode::cancelled);
}

TEST(Parametrize, EveryTable_HasARowPerFileVertex) {
  Model model = testing::make_strip(4);
  const std::uint32_t ball = testing::append(model, testing::make_ball({2, 0.5F, 0}, 0.3F), "EyeLeft");
  model.positions.emplace_back(9, 9, 9);  // used by no triangle
  const auto rig = parametrize_model(model, testing::points_at(model, {{"2.1", 0}, {"2.2", 4}}));
  ASSERT_TRUE(rig);
  const std::size_t count = model.positions.size();
  EXPECT_EQ(rig->weights.row_count(), count);
  EXPECT_EQ(rig->influence.row_count(), count);
  EXPECT_EQ(rig->rigid_of_vertex.size(), count);
  ASSERT_EQ(rig->part_of_vertex.size(), count);
  for (const PartId part : rig->part_of_vertex) EXPECT_LT(part.value(), rig->parts.size());
  EXPECT_EQ(rig->rigid_of_vertex[0], RigidMotion::none);
  EXPECT_EQ(rig->rigid_of_vertex[ball], RigidMotion::left_eye);
  EXPECT_EQ(rig->rigid_of_vertex.back(), RigidMotion::none);
}

TEST(Parametrize, Weights_KnowNoRoles) {
  // A tooth's own points give it weights of Eq. 4, though its row of influence is the jaw's alone.
  Model model = testing::make_strip(8);
  const std::uint32_t tooth =
      testing::append(model, testing::shifted(testing::make_strip(4), {0, 0, -5}), "teeth lower");
  const auto rig = parametrize_model(
      model, testing::points_at(model, {{"2.1", 0}, {"2.2", 4}, {"9.9", tooth}, {"9.11", tooth + 4}}));
  ASSERT_TRUE(rig);
  EXPECT_EQ(rig->weights.points_of(tooth + 1).size(), 2U);
  ASSERT_EQ(rig->influence.points_of(tooth + 1).size(), 1U);
  EXPECT_EQ(rig->influence.points_of(tooth + 1)[0], testing::fp("2.1"));
}

TEST(Parametrize, FapuByHand_ReplacesTheMeasured) {
  const Model model = testing::make_strip(4);
  ParametrizeOptions options;
  options.fapu_by_user.value[static_cast<std::size_t>(FapuUnit::mw)] = 0.25;
  const auto rig = parametrize_model(model, testing::points_at(model, {{"8.4", 0}, {"8.3", 4}}), options);
  ASSERT_TRUE(rig);
  EXPECT_EQ(rig->fapu[FapuUnit::mw], 0.25);
  EXPECT_THAT(rig->warnings, Not(Contains(HasSubstr("MW"))));
  EXPECT_THAT(rig->warnings, Contains(HasSubstr("MNS")));
}

TEST(Parametrize, WhatIsMissing_BecomesAWarning) {
  Model model = testing::make_strip(8);
  testing::append(model, testing::shifted(testing::make_strip(1), {0, 0, -5}), "tongue");
  model.positions.emplace_back(9, 9, 9);
  const auto loose = static_cast<std::uint32_t>(model.positions.size() - 1);
  const auto rig = parametrize_model(model, testing::points_at(model, {{"4.1", 0}, {"4.2", 0}, {"4.3", loose}}));
  ASSERT_TRUE(rig);
  EXPECT_THAT(rig->warnings, Contains(HasSubstr("2.1 is not marked")));
  EXPECT_THAT(rig->warnings, Contains(HasSubstr("7.1 is not marked")));
  EXPECT_THAT(rig->warnings, Contains(HasSubstr("no part is the left eye")));
  EXPECT_THAT(rig->warnings, Contains(HasSubstr("4.1 and 4.2 are at the same place")));
  EXPECT_THAT(rig->warnings, Contains(HasSubstr("4.3 is at a vertex that no triangle uses")));
}

TEST(Parametrize, NoPointsAtAll_MovesNothingAndSaysSo) {
  const auto rig = parametrize_model(testing::make_strip(4), {});
  ASSERT_TRUE(rig);
  EXPECT_TRUE(rig->influence.points.empty());
  EXPECT_THAT(rig->warnings, Contains(HasSubstr("nothing will move")));
}

TEST(Parametrize, ClosedEyes_BecomeAWarning) {
  const auto warnings_of = [](const SampleHeadTraits& traits) {
    const auto rig = parametrize_model(testing::sample_head_model(traits), testing::sample_head_points(traits));
    return rig ? rig->warnings : std::vector<std::string>{rig.error().message};
  };
  EXPECT_THAT(warnings_of({.closed_eyes = true}), Contains(HasSubstr("the eyes are closed: ES0 is the distance")));
  EXPECT_THAT(warnings_of({}), Not(Contains(HasSubstr("closed"))));
}

TEST(Parametrize, BarePoint_InfluencesNothing) {
  const Model model = testing::make_strip(4);
  FeaturePointSet points = testing::points_at(model, {{"2.1", 0}, {"2.2", 4}});
  const auto without = parametrize_model(model, points);
  points.push_back({testing::fp("7.1"), std::nullopt, glm::vec3(2, 0.5F, 0)});
  const auto with = parametrize_model(model, points);
  ASSERT_TRUE(with);
  EXPECT_EQ(with->weights.weights, without->weights.weights);
  EXPECT_EQ(with->head_pivot, glm::vec3(2, 0.5F, 0));
}

/// The sample head with a floor in the socket of its left eye, inside the ball: a step inwards from the edges of the
/// lids, and a fan from there. So heads are made whose makers left out what the eyeball hides.
Model with_socket_floor(Model model, const FeaturePointSet& points) {
  const Surface surface = build_surface(model);
  const auto edges = find_eye_edges(surface, surface_points(surface, points), 0).value();
  const glm::vec3 middle(0.5 * (edges.upper.middle.position + edges.lower.middle.position));
  const auto height = static_cast<float>(edges.upper.middle.position.y - edges.lower.middle.position.y);
  const auto add_vertex = [&](const glm::vec3& at) {
    model.positions.push_back(at);
    return static_cast<std::uint32_t>(model.positions.size() - 1);
  };
  const auto add_triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::vec3 u = model.positions[b] - model.positions[a];
    const glm::vec3 v = model.positions[c] - model.positions[a];
    model.triangles.push_back(u.x * v.y - u.y * v.x > 0.0F ? Triangle{a, b, c} : Triangle{a, c, b});
    ++model.primitives.back().triangle_count;
  };
  const std::uint32_t floor = add_vertex(middle - glm::vec3(0.0F, 0.0F, 0.5F * height));
  for (const LidEdge* const edge : {&edges.upper, &edges.lower}) {
    for (const auto& way : edge->to_corner) {
      std::vector<std::uint32_t> rim;
      std::vector<std::uint32_t> step;
      for (const SurfaceVertexId v : way) {
        rim.push_back(surface.file_vertex_of[v.value()].value());
        const glm::vec3 at = model.positions[rim.back()];
        step.push_back(add_vertex({at.x, at.y + 0.05F * (middle.y - at.y), at.z - 0.3F * height}));
      }
      for (std::size_t k = 1; k < rim.size(); ++k) {
        add_triangle(rim[k - 1], rim[k], step[k - 1]);
        add_triangle(rim[k], step[k], step[k - 1]);
        add_triangle(step[k - 1], step[k], floor);
      }
    }
  }
  return model;
}

// The floor folds where nobody sees it.
TEST(Parametrize, LidsOverASocketWithAFloor_CloseAsThoseOverAnOpenOne) {
  const FeaturePointSet points = testing::sample_head_points();
  const Model model = with_socket_floor(testing::sample_head_model(), points);
  const Surface surface = build_surface(model);
  ASSERT_TRUE(are_joined(surface, mpeg4::lids_of(0), surface_points(surface, points)));
  ParametrizeOptions options;
  options.weights = WeightMethod::smooth;
  const auto rig = parametrize(model, surface, points, options);
  ASSERT_TRUE(rig);
  ASSERT_TRUE(rig->lids[0] && rig->lids[1]);
  EXPECT_NEAR(rig->lids[0]->opening, rig->lids[1]->opening, 0.02F * rig->lids[1]->opening);
}

}  // namespace
}  // namespace semblante

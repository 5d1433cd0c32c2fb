#include "core/parametrize/weights.h"

#include <cmath>
#include <map>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/parametrize/surface_weights.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

constexpr double exact = 1e-15;

std::map<std::string, double> row_of(const WeightTable<double>& table, std::uint32_t vertex) {
  std::map<std::string, double> row;
  const auto ids = table.points_of(vertex);
  for (std::size_t k = 0; k < ids.size(); ++k) row[to_string(ids[k])] = table.weights_of(vertex)[k];
  return row;
}

WeightTable<double> weights_on(const Model& model,
                               std::initializer_list<std::pair<std::string_view, std::uint32_t>> marks) {
  const Surface surface = build_surface(model);
  auto weights = surface_weights(surface, surface_points(surface, testing::points_at(model, marks)));
  EXPECT_TRUE(weights);
  return rows_of_file_vertices(surface, weights->rows);
}

/// Points 2.1, 2.2, 2.3 at b0, b4, b8 of a strip of eight squares; t0 is vertex 9.
class StripOfThreePoints : public ::testing::Test {
 protected:
  const WeightTable<double> table_ = weights_on(testing::make_strip(8), {{"2.1", 0}, {"2.2", 4}, {"2.3", 8}});
};

TEST_F(StripOfThreePoints, BetweenTwo_TwoValidNeighbors_Eq1And3) {
  // b2. At i = 2.1 both neighbours lie straight ahead: cos 1, d_ij 4 and 8, d = (4 + 8) / 2 = 6;
  //     W = sin(pi/2 (1 - 2/6)) = sin 60 deg.
  // (2.3 is a neighbour of 2.1 since the region of t4, right above 2.2, holds all three.)
  // At i = 2.2, P lies to the left: 2.1 has cos 1, 2.3 cos -1; one valid neighbour, d = 4 / 1;
  //     W = sin(pi/2 (1 - 2/4)) = sin 45 deg.
  EXPECT_THAT(row_of(table_, 2), ElementsAre(Pair("2.1", DoubleNear(std::sqrt(3.0) / 2.0, exact)),
                                             Pair("2.2", DoubleNear(std::sqrt(0.5), exact))));
}

TEST_F(StripOfThreePoints, OneValidNeighborAtAnAngle_Eq2KeepsTheCosine) {
  // t2 = (2, 1) is vertex 11. At i = 2.2 = (4, 0): P - i = (-2, 1), towards 2.1 (-4, 0): cos = 2/sqrt 5; towards 2.3
  // -2/sqrt 5. d = 4 sqrt(5) / 2 = 2 sqrt 5 (Eq. 3 with n = 1 would say 4). d_iP = t2-b3-b4 = sqrt 2 + 1.
  const double d = 2.0 * std::sqrt(5.0);
  const double expected = std::sin(std::numbers::pi / 2.0 * (1.0 - (std::sqrt(2.0) + 1.0) / d));
  const auto row = row_of(table_, 11);
  ASSERT_TRUE(row.contains("2.2"));
  EXPECT_NEAR(row.at("2.2"), expected, exact);
}

TEST_F(StripOfThreePoints, RightAngle_IsNoValidNeighbor) {
  // t4 = (4, 1) is vertex 13, right above 2.2: P - i = (0, 1) at right angles to both neighbours, so 2.2 has none and
  // does not move it, near as it is. At 2.1: P - i = (4, 1), both neighbours along x with the same cos, so
  // d = (4 + 8) / 2 = 6; d_iP = 5: up once, along four times. At 2.3 likewise, by the diagonal t4-b5: sqrt 2 + 3.
  EXPECT_THAT(
      row_of(table_, 13),
      ElementsAre(
          Pair("2.1", DoubleNear(std::sin(std::numbers::pi / 12.0), exact)),
          Pair("2.3", DoubleNear(std::sin(std::numbers::pi / 2.0 * (1.0 - (std::sqrt(2.0) + 3.0) / 6.0)), exact))));
}

TEST_F(StripOfThreePoints, PointsOwnVertex_FollowsItAlone) {
  EXPECT_THAT(row_of(table_, 0), ElementsAre(Pair("2.1", 1.0)));
  EXPECT_THAT(row_of(table_, 4), ElementsAre(Pair("2.2", 1.0)));
}

TEST(Weights, BehindTheOnlyNeighbor_NothingMovesIt) {
  // Points at b2 and b3; b5 sees 2.2 first, which cuts 2.1 off. At 2.2 the one neighbour lies backwards: not valid.
  const auto table = weights_on(testing::make_strip(6), {{"2.1", 2}, {"2.2", 3}});
  EXPECT_THAT(row_of(table, 5), IsEmpty());
}

TEST(Weights, LonePoint_MovesItsVertexOnly) {
  const auto table = weights_on(testing::make_strip(3), {{"2.1", 1}});
  EXPECT_THAT(row_of(table, 1), ElementsAre(Pair("2.1", 1.0)));
  for (const std::uint32_t v : {0U, 2U, 3U, 4U, 5U}) EXPECT_THAT(row_of(table, v), IsEmpty());
}

TEST(Weights, FartherThanD_DoesNotMove) {
  // i = (0,0,0) and j = (2,0,0) joined directly (d_ij = 2); P = (1,0,0) hangs between them by a detour over (0.5,2,.)
  // and (1.5,2,.): d_iP = 2 sqrt(0.25 + 4) = 4.12 > d = 2 / cos 0.
  const Model model = testing::make_model(
      {{0, 0, 0}, {2, 0, 0}, {1, -1, 0}, {1, 0, 0}, {0.5F, 2, 0}, {0.5F, 2, 1}, {1.5F, 2, 0}, {1.5F, 2, 1}},
      {{0, 1, 2}, {0, 4, 5}, {4, 3, 5}, {3, 6, 7}, {6, 1, 7}});
  const auto table = weights_on(model, {{"2.1", 0}, {"2.2", 1}});
  EXPECT_THAT(row_of(table, 3), IsEmpty());
  // (1, -1, 0) is in reach: d_iP = sqrt 2, cos 45 deg, d = 2 sqrt 2, so W = sin 45 deg from either side.
  EXPECT_THAT(row_of(table, 2), ElementsAre(Pair("2.1", DoubleNear(std::sqrt(0.5), exact)),
                                            Pair("2.2", DoubleNear(std::sqrt(0.5), exact))));
}

TEST(Weights, OtherPart_IsNotReached) {
  Model model = testing::make_strip(4);
  const std::uint32_t other = testing::append(model, testing::shifted(testing::make_strip(4), {0, 0, 5}), "");
  const auto table = weights_on(model, {{"2.1", 0}, {"2.2", 4}});
  for (std::uint32_t v = other; v < model.positions.size(); ++v) EXPECT_THAT(row_of(table, v), IsEmpty());
}

TEST(Weights, TwoPointsAtOneVertex_BothMoveItFully) {
  const auto table = weights_on(testing::make_strip(4), {{"2.1", 0}, {"2.2", 0}, {"2.3", 4}});
  EXPECT_THAT(row_of(table, 0), ElementsAre(Pair("2.1", 1.0), Pair("2.2", 1.0)));
  // b2: between the two there is no direction, so 2.3 is the one valid neighbour of either: d = 4, W = sin 45 deg.
  const auto row = row_of(table, 2);
  EXPECT_NEAR(row.at("2.1"), std::sqrt(0.5), exact);
  EXPECT_NEAR(row.at("2.2"), std::sqrt(0.5), exact);
}

TEST(Weights, SeamThroughThePoint_BothFileVerticesFollow) {
  // Two squares whose common side is split: vertices 1, 2 and 4, 5 coincide; the point is marked on one of them.
  const Model model = testing::make_model({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}},
                                          {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}});
  const auto table = weights_on(model, {{"2.1", 1}, {"2.2", 3}});
  EXPECT_THAT(row_of(table, 1), ElementsAre(Pair("2.1", 1.0)));
  EXPECT_THAT(row_of(table, 4), ElementsAre(Pair("2.1", 1.0)));
  EXPECT_EQ(row_of(table, 2), row_of(table, 5));
}

TEST(Weights, VertexAtThePlaceOfThePoint_MovesWithIt) {
  // 1 and 2 share a place, joined by the inner edge of two triangles without area; the point is at 1.
  const Model model = testing::make_model({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}},
                                          {{0, 1, 2}, {1, 3, 2}, {0, 4, 1}, {1, 4, 3}, {0, 2, 5}, {2, 3, 5}});
  ASSERT_EQ(build_surface(model).vertex_count(), 6U);
  const auto table = weights_on(model, {{"2.1", 1}, {"2.2", 3}});
  EXPECT_EQ(row_of(table, 1), (std::map<std::string, double>{{"2.1", 1.0}}));
  EXPECT_EQ(row_of(table, 2).at("2.1"), 1.0);
}

TEST(Weights, Progress_RisesAndStopsOnRequest) {
  const Model model = testing::make_strip(4);
  const Surface surface = build_surface(model);
  const auto points = surface_points(surface, testing::points_at(model, {{"2.1", 0}, {"2.2", 4}}));
  double last = 0.0;
  ASSERT_TRUE(surface_weights(surface, points, [&](double progress, std::string_view stage) {
    EXPECT_GE(progress, last);
    EXPECT_LE(progress, 1.0);
    EXPECT_FALSE(stage.empty());
    last = progress;
    return true;
  }));
  EXPECT_GT(last, 0.5);
  const auto stopped = surface_weights(surface, points, [](double, std::string_view) { return false; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace semblante

#include "core/parametrize/place_feature_points.h"

#include <algorithm>
#include <limits>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

using testing::at_position;
using testing::at_vertex;
using ::testing::ElementsAre;
using testing::fp;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A skin of 20 x 20 squares and an eyeball in front of it, whose first vertex is `eye_`.
class PlaceFeaturePoints : public ::testing::Test {
 protected:
  PlaceFeaturePoints() {
    eye_ = testing::append(model_, testing::make_ball({5, 15, 0}, 1.5F), "");
    surface_ = build_surface(model_);
  }
  Result<FeaturePointSet> place(const std::vector<MarkedPoint>& marked,
                                const std::vector<std::optional<PartRole>>& roles = {}) {
    warnings_.clear();
    return place_feature_points(model_, surface_, marked, &warnings_, roles);
  }
  void expect_error(const std::vector<MarkedPoint>& marked, ErrorCode code, const std::string& where,
                    const std::vector<std::optional<PartRole>>& roles = {}) {
    const auto placed = place(marked, roles);
    ASSERT_FALSE(placed);
    EXPECT_EQ(placed.error().code, code);
    EXPECT_EQ(placed.error().where, where);
    EXPECT_FALSE(placed.error().message.empty());
  }
  MarkedPoint at_both(std::string_view name, std::uint32_t vertex, const glm::dvec3& position) {
    return {fp(name), vertex, position};
  }

  Model model_ = testing::make_grid(20, 20);
  std::uint32_t eye_ = 0;
  Surface surface_;
  std::vector<std::string> warnings_;
};

TEST_F(PlaceFeaturePoints, InvalidInput_NamesThePointAndTheReason) {
  const auto count = static_cast<std::uint32_t>(model_.positions.size());
  expect_error({at_vertex("2.1", count)}, ErrorCode::out_of_range, "/points/2.1/vertex");
  expect_error({at_vertex("2.1", 0xFFFFFFFFU)}, ErrorCode::out_of_range, "/points/2.1/vertex");
  // Out of range even where a position could stand in: the file and the model do not belong together.
  expect_error({at_both("2.1", count, {0, 0, 0})}, ErrorCode::out_of_range, "/points/2.1/vertex");
  expect_error({{fp("4.1"), std::nullopt, std::nullopt}}, ErrorCode::missing, "/points/4.1");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  expect_error({at_position("2.1", {nan, 0, 0})}, ErrorCode::not_finite, "/points/2.1/position");
  expect_error({at_position("2.1", {0, 0, -infinite})}, ErrorCode::not_finite, "/points/2.1/position");
  expect_error({at_vertex("2.1", 1), at_vertex("2.1", 2)}, ErrorCode::invalid_argument, "/points/2.1");
  // The diagonal of the box is about 28.4: 5 % are 1.4.
  expect_error({at_position("2.1", {0, 0, 5})}, ErrorCode::invalid_argument, "/points/2.1/position");
}

TEST_F(PlaceFeaturePoints, SkinPointOnAPartThatCannotBeSkin_IsRefused) {
  // The pupil on the ball makes it an eye.
  expect_error({at_vertex("2.1", 0), at_vertex("3.5", eye_), at_vertex("3.1", eye_ + 1)}, ErrorCode::invalid_argument,
               "/points/3.1");
  // Nothing but the user says so.
  expect_error({at_vertex("8.1", eye_)}, ErrorCode::invalid_argument, "/points/8.1",
               {std::nullopt, PartRole::upper_teeth});
}

TEST_F(PlaceFeaturePoints, SkinPointWhereNothingSpeaksAgainstIt_IsTaken) {
  EXPECT_TRUE(place({at_vertex("8.1", eye_)}));
  EXPECT_TRUE(place({at_vertex("8.1", eye_)}, {std::nullopt, PartRole::attached}));
  // Eyes that are painted on the skin: the pupil lies on it too.
  EXPECT_TRUE(place({at_vertex("2.1", 0), at_vertex("3.5", 8), at_vertex("3.1", 9)}));
}

TEST_F(PlaceFeaturePoints, Vertices_AreTakenAsTheyAre_SortedById) {
  const auto placed = place({at_vertex("8.1", 7), at_vertex("2.10", 5), at_vertex("2.2", 3)});
  ASSERT_TRUE(placed);
  ASSERT_EQ(placed->size(), 3U);
  EXPECT_EQ(placed->at(0).id, fp("2.2"));
  EXPECT_EQ(placed->at(1).id, fp("2.10"));
  EXPECT_EQ(placed->at(2).id, fp("8.1"));
  EXPECT_EQ(placed->at(2).vertex, VertexId(7));
  EXPECT_EQ(placed->at(2).position, model_.positions[7]);
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(PlaceFeaturePoints, EveryDisagreeingPositionHasAVertex_FileWasRenumbered) {
  const auto placed = place({at_both("2.1", 0, {3, 4, 0}), at_both("2.2", 5, {5, 0, 0}), at_vertex("2.3", 9)});
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->at(0).vertex, VertexId(4 * 21 + 3));
  EXPECT_EQ(placed->at(1).vertex, VertexId(5));  // agreed all along
  EXPECT_EQ(placed->at(2).vertex, VertexId(9));  // has no position that could win
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("2.1")));
}

TEST_F(PlaceFeaturePoints, OneDisagreeingPositionHasNoVertex_VerticesWin) {
  const auto placed = place({at_both("2.1", 0, {3, 4, 0}), at_both("2.2", 5, {5.5, 0, 0})});
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->at(0).vertex, VertexId(0));
  EXPECT_EQ(placed->at(1).vertex, VertexId(5));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("2.1, 2.2")));
}

TEST_F(PlaceFeaturePoints, PositionRoundedInPrint_Agrees) {
  const auto placed = place({at_both("2.1", 2, {2.0004, 0, 0})});
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->at(0).vertex, VertexId(2));
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(PlaceFeaturePoints, PositionAtAVertex_IsThatVertex) {
  const auto placed = place({at_position("2.1", {3, 4, 0.001}), at_position("7.1", {1, 1, 0})});
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->at(0).vertex, VertexId(4 * 21 + 3));
  EXPECT_EQ(placed->at(1).vertex, VertexId(22));
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(PlaceFeaturePoints, SeveralVerticesAtAPosition_ThePartWithMostVerticesThenTheLowestIndex) {
  // A small part of its own at (3, 4, 0), numbered first or last, must not take the point from the skin.
  Model model = testing::make_model({{3, 4, 0}, {3, 4, 1}, {3, 5, 1}}, {{0, 1, 2}});
  const std::uint32_t skin = testing::append(model, testing::make_grid(20, 20), "");
  testing::append(model, testing::make_model({{3, 4, 0}, {3, 4, 1}, {3, 5, 1}}, {{0, 1, 2}}), "");
  const Surface surface = build_surface(model);
  const auto placed = place_feature_points(model, surface, std::vector{at_position("2.1", {3, 4, 0})}, nullptr);
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->at(0).vertex, VertexId(skin + 4 * 21 + 3));
}

TEST_F(PlaceFeaturePoints, InnerPointsOffTheSurface_StayBare) {
  const auto placed = place({at_position("3.5", {5.2, 15.1, 1.3}), at_position("7.1", {10, 5, -40})});
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->at(0).vertex, std::nullopt);
  EXPECT_EQ(placed->at(0).position, glm::vec3(5.2F, 15.1F, 1.3F));
  EXPECT_EQ(placed->at(1).vertex, std::nullopt);
}

TEST_F(PlaceFeaturePoints, PositionInsideATriangle_IsThatPlace) {
  // The square (7, 2) is split from (7, 2) to (8, 3) or across; either way (7.5, 2.3) is inside a triangle.
  const auto placed = place({at_position("8.1", {7.5, 2.3, 0})});
  ASSERT_TRUE(placed);
  const FeaturePoint& point = placed->at(0);
  EXPECT_EQ(point.vertex, std::nullopt);
  EXPECT_EQ(point.position, glm::vec3(7.5F, 2.3F, 0.0F));
  ASSERT_TRUE(point.between);
  glm::dvec3 there(0.0);
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(point.between->shares[c], 0.0);
    there += point.between->shares[c] *
             glm::dvec3(model_.positions[model_.triangles[point.between->triangle][static_cast<std::size_t>(c)]]);
  }
  EXPECT_LT(glm::distance(there, {7.5, 2.3, 0}), 1e-6);
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(PlaceFeaturePoints, PositionBesideAVertex_IsTheVertex_BesideAnEdge_OnTheEdge) {
  const auto placed =
      place({at_position("2.1", {3.06, 4.05, 0}), at_position("8.1", {7.5, 2.03, 0}), at_position("8.2", {3.2, 4, 0})});
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->at(0).vertex, VertexId(4 * 21 + 3)) << "0.08 of an edge away";
  ASSERT_TRUE(placed->at(1).between);
  EXPECT_EQ(placed->at(1).position.y, 2.0F) << "0.03 of the way to the other side of the triangle";
  EXPECT_EQ(glm::min(placed->at(1).between->shares.x,
                     glm::min(placed->at(1).between->shares.y, placed->at(1).between->shares.z)),
            0.0);
  EXPECT_TRUE(placed->at(2).between) << "0.2 of an edge away from the vertex";
}

TEST_F(PlaceFeaturePoints, PositionOffTheSurface_IsTheNearestPlaceOnIt_WithAWarning) {
  const auto placed = place({at_position("2.1", {3.2, 4.5, 0.5}), at_position("8.1", {7, 2, 0.5})});
  ASSERT_TRUE(placed);
  EXPECT_TRUE(placed->at(0).between);
  EXPECT_EQ(placed->at(0).position, glm::vec3(3.2F, 4.5F, 0.0F));
  EXPECT_EQ(placed->at(1).vertex, VertexId(2 * 21 + 7));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("2.1, 8.1")));
}

TEST_F(PlaceFeaturePoints, BetweenVerticesOfAPartThatCannotBeSkin_IsRefused) {
  const glm::vec3 inside =
      (model_.positions[eye_ + 17] + model_.positions[eye_ + 18] + model_.positions[eye_ + 34]) / 3.0F;
  expect_error({at_vertex("2.1", 0), at_vertex("3.5", eye_), at_position("3.1", glm::dvec3(inside))},
               ErrorCode::invalid_argument, "/points/3.1");
}

TEST_F(PlaceFeaturePoints, VertexWithoutTriangles_IsNoPlaceForAPosition) {
  model_.positions.emplace_back(3, 4, 0.5F);
  surface_ = build_surface(model_);
  const auto placed = place({at_position("2.1", {3, 4, 0.5})});
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->at(0).vertex, VertexId(4 * 21 + 3));
}

/// A mouth that is shut: a vertex of either lip at every place of its rim.
class PlaceOnAClosedMouth : public ::testing::Test {
 protected:
  FeaturePointSet place(std::vector<MarkedPoint> marked) {
    for (const auto& [name, row] : {std::pair("8.1", 1), std::pair("8.2", -1)})
      marked.push_back(at_vertex(name, mouth_.at(0, row)));
    marked.push_back(at_vertex("2.4", mouth_.at(2, 0)));
    marked.push_back(at_vertex("2.5", mouth_.at(-2, 0)));
    auto placed = place_feature_points(mouth_.model, build_surface(mouth_.model), marked, nullptr);
    EXPECT_TRUE(placed);
    return placed ? *placed : FeaturePointSet();
  }
  static VertexId vertex_of(const FeaturePointSet& points, std::string_view name) {
    for (const FeaturePoint& point : points) {
      if (point.id == fp(name)) return *point.vertex;
    }
    ADD_FAILURE() << name;
    return VertexId(0);
  }
  testing::ClosedMouth mouth_ = testing::make_closed_mouth();
};

TEST_F(PlaceOnAClosedMouth, AtAPlaceOfBothLips_EachPointGetsItsOwn) {
  const auto placed = place({at_position("2.2", {0, 0, 0}), at_position("2.3", {0, 0, 0}),
                             at_position("2.6", {1, 0, 0}), at_position("2.8", {1, 0, 0})});
  EXPECT_EQ(vertex_of(placed, "2.2"), VertexId(mouth_.at(0, 0, true)));
  EXPECT_EQ(vertex_of(placed, "2.3"), VertexId(mouth_.at(0, 0, false)));
  EXPECT_EQ(vertex_of(placed, "2.6"), VertexId(mouth_.at(1, 0, true)));
  EXPECT_EQ(vertex_of(placed, "2.8"), VertexId(mouth_.at(1, 0, false)));
}

TEST_F(PlaceOnAClosedMouth, BetweenVertices_EachPointIsOnItsOwnLip) {
  // The lips pass each other, so the place of 2.2, a little below the rim of the upper lip, is nearest to the lower
  // lip.
  for (const int column : {-1, 0, 1}) mouth_.model.positions[mouth_.at(column, 0, true)].y = -0.1F;
  const auto placed = place({at_position("2.2", {0.3, 0.05, 0.02}), at_position("2.3", {0.3, -0.15, 0.02})});
  for (const auto& [name, upper] : {std::pair("2.2", true), std::pair("2.3", false)}) {
    const auto point =
        std::find_if(placed.begin(), placed.end(), [id = fp(name)](const FeaturePoint& one) { return one.id == id; });
    ASSERT_NE(point, placed.end());
    ASSERT_TRUE(point->between) << name;
    const Triangle& triangle = mouth_.model.triangles[point->between->triangle];
    const auto is_corner = [&](std::uint32_t vertex) {
      return std::find(triangle.begin(), triangle.end(), vertex) != triangle.end();
    };
    EXPECT_TRUE(is_corner(mouth_.at(0, 0, upper)) || is_corner(mouth_.at(1, 0, upper))) << name;
    EXPECT_FALSE(is_corner(mouth_.at(0, 0, !upper)) || is_corner(mouth_.at(1, 0, !upper))) << name;
  }
}

TEST_F(PlaceOnAClosedMouth, AtTheOnlyVertexThere_ItStays) {
  EXPECT_EQ(vertex_of(place({at_position("8.5", {1, -2, 0})}), "8.5"), VertexId(mouth_.at(1, -2)))
      << "somebody marked that vertex; the doctor tells what is wrong with it";
}

}  // namespace
}  // namespace semblante

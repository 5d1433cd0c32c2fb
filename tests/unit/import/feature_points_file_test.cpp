#include "core/import/feature_points_file.h"

#include <string>

#include <gtest/gtest.h>

#include "core/import/axes.h"

namespace semblante {
namespace {

struct InvalidPoints {
  const char* name;
  const char* json;
  ErrorCode code;
  const char* where;
};

void PrintTo(const InvalidPoints& invalid, std::ostream* out) { *out << invalid.name; }

class InvalidFile : public ::testing::TestWithParam<InvalidPoints> {};

TEST_P(InvalidFile, IsRefused_NamingTheMember) {
  const auto file = parse_feature_points(GetParam().json);
  ASSERT_FALSE(file);
  EXPECT_EQ(static_cast<int>(file.error().code), static_cast<int>(GetParam().code)) << file.error().message;
  EXPECT_EQ(file.error().where, GetParam().where) << file.error().message;
  EXPECT_FALSE(file.error().message.empty());
}

const InvalidPoints invalid_point_files[] = {
    {"Nothing", "", ErrorCode::malformed, ""},
    {"NoJson", "hello", ErrorCode::malformed, ""},
    {"CutShort", R"({"points": {"2.1": {"vertex": 1)", ErrorCode::malformed, ""},
    {"TrailingText", R"({"points": {"2.1": {"vertex": 1}}} x)", ErrorCode::malformed, ""},
    {"Array", "[]", ErrorCode::malformed, ""},
    {"NoPoints", "{}", ErrorCode::missing, "/points"},
    {"PointsAreAList", R"({"points": []})", ErrorCode::malformed, "/points"},
    {"NoPointAtAll", R"({"points": {}})", ErrorCode::empty, "/points"},
    {"UnknownId", R"({"points": {"2.15": {"vertex": 1}}})", ErrorCode::invalid_argument, "/points/2.15"},
    {"GroupOne", R"({"points": {"1.1": {"vertex": 1}}})", ErrorCode::invalid_argument, "/points/1.1"},
    {"SecondSpelling", R"({"points": {"2.01": {"vertex": 1}}})", ErrorCode::invalid_argument, "/points/2.01"},
    {"IdWithSlash", R"({"points": {"a/b~": {"vertex": 1}}})", ErrorCode::invalid_argument, "/points/a~1b~0"},
    {"PointIsANumber", R"({"points": {"2.1": 7}})", ErrorCode::malformed, "/points/2.1"},
    {"PointIsEmpty", R"({"points": {"2.1": {}}})", ErrorCode::missing, "/points/2.1"},
    {"PointHasNeither", R"({"points": {"2.1": {"vertex": null}}})", ErrorCode::missing, "/points/2.1"},
    {"VertexIsAText", R"({"points": {"2.1": {"vertex": "12"}}})", ErrorCode::malformed, "/points/2.1/vertex"},
    {"VertexIsNegative", R"({"points": {"2.1": {"vertex": -1}}})", ErrorCode::out_of_range, "/points/2.1/vertex"},
    {"VertexIsAFraction", R"({"points": {"2.1": {"vertex": 1.5}}})", ErrorCode::malformed, "/points/2.1/vertex"},
    {"VertexIsTooLarge", R"({"points": {"2.1": {"vertex": 4294967296}}})", ErrorCode::out_of_range,
     "/points/2.1/vertex"},
    {"VertexIsBeyondAnyInteger", R"({"points": {"2.1": {"vertex": 99999999999999999999}}})", ErrorCode::out_of_range,
     "/points/2.1/vertex"},
    {"VertexIsTrue", R"({"points": {"2.1": {"vertex": true}}})", ErrorCode::malformed, "/points/2.1/vertex"},
    {"PositionIsAText", R"({"points": {"2.1": {"position": "0 0 0"}}})", ErrorCode::malformed, "/points/2.1/position"},
    {"PositionHasTwo", R"({"points": {"2.1": {"position": [1, 2]}}})", ErrorCode::malformed, "/points/2.1/position"},
    {"PositionHasFour", R"({"points": {"2.1": {"position": [1, 2, 3, 4]}}})", ErrorCode::malformed,
     "/points/2.1/position"},
    {"PositionHasAText", R"({"points": {"2.1": {"position": [1, "2", 3]}}})", ErrorCode::malformed,
     "/points/2.1/position/1"},
    {"PositionHasNull", R"({"points": {"2.1": {"position": [1, 2, null]}}})", ErrorCode::malformed,
     "/points/2.1/position/2"},
    {"PositionIsNaN", R"({"points": {"2.1": {"position": [NaN, 0, 0]}}})", ErrorCode::malformed, ""},
    {"PositionIsBeyondDouble", R"({"points": {"2.1": {"position": [1e999, 0, 0]}}})", ErrorCode::not_finite,
     "/points/2.1/position/0"},
    {"PositionIsBeyondFloat", R"({"points": {"2.1": {"position": [1e300, 0, 0]}}})", ErrorCode::out_of_range,
     "/points/2.1/position/0"},
    {"PointTwice", R"({"points": {"2.1": {"vertex": 1}, "2.1": {"vertex": 2}}})", ErrorCode::malformed, "/points/2.1"},
    {"VertexTwice", R"({"points": {"2.1": {"vertex": 1, "vertex": 2}}})", ErrorCode::malformed, "/points/2.1/vertex"},
    {"BaseOne", R"({"vertex_index_base": 1, "points": {"2.1": {"vertex": 1}}})", ErrorCode::unsupported,
     "/vertex_index_base"},
    {"AxesAreFlat", R"({"points": {"2.1": {"vertex": 1}}, "to_mpeg4_axes": [[1,0,0],[0,1,0],[0,0,0]]})",
     ErrorCode::invalid_argument, "/to_mpeg4_axes"},
    {"AxesHaveTwoRows", R"({"points": {"2.1": {"vertex": 1}}, "to_mpeg4_axes": [[1,0,0],[0,1,0]]})",
     ErrorCode::malformed, "/to_mpeg4_axes"},
    {"AxesHaveAText", R"({"points": {"2.1": {"vertex": 1}}, "to_mpeg4_axes": [[1,0,0],[0,"x",0],[0,0,1]]})",
     ErrorCode::malformed, "/to_mpeg4_axes/1/1"},
};

INSTANTIATE_TEST_SUITE_P(FeaturePointsFile, InvalidFile, ::testing::ValuesIn(invalid_point_files),
                         [](const auto& test) { return test.param.name; });

TEST(FeaturePointsFile, Points_ComeInRisingOrder_WhateverTheFileSays) {
  const auto file = parse_feature_points(R"({"head": "x", "count": 3, "points": {
      "11.6": {"position": [0.5, -1, 2e-3], "placed": "by hand", "confidence": "low"},
      "2.10": {"vertex": 4294967295},
      "2.9": {"vertex": 0, "position": [1, 2, 3]},
      "7.1": {"vertex": null, "position": [0, 0, 0]}}})");
  ASSERT_TRUE(file) << file.error().message;
  ASSERT_EQ(file->points.size(), 4U);
  EXPECT_EQ(to_string(file->points[0].id), "2.9");
  EXPECT_EQ(to_string(file->points[1].id), "2.10");
  EXPECT_EQ(to_string(file->points[2].id), "7.1");
  EXPECT_EQ(to_string(file->points[3].id), "11.6");
  EXPECT_EQ(file->points[0].vertex, 0U);
  EXPECT_EQ(*file->points[0].position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(file->points[1].vertex, 4294967295U);
  EXPECT_FALSE(file->points[1].position);
  EXPECT_FALSE(file->points[2].vertex);
  EXPECT_EQ(*file->points[3].position, glm::dvec3(0.5, -1, 2e-3));
  EXPECT_FALSE(file->to_mpeg4_axes);
}

TEST(FeaturePointsFile, Proposed_IsAMark_OfTruthOrNotAtAll) {
  const auto file = parse_feature_points(R"({"points": {"2.1": {"vertex": 1, "proposed": true, "confidence": "high"},
      "2.2": {"vertex": 2, "proposed": false}, "2.3": {"vertex": 3, "proposed": null}, "2.4": {"vertex": 4}}})");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(file->points[0].proposed);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_FALSE(file->points[i].proposed) << i;
  const auto other = parse_feature_points(R"({"points": {"2.1": {"vertex": 1, "proposed": 1}}})");
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().where, "/points/2.1/proposed");
}

TEST(FeaturePointsFile, AnyPrefix_IsRefused_WithoutACrash) {
  const std::string whole = R"({"points": {"2.1": {"vertex": 7, "position": [1.5, -2, 3e1]}}})";
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(parse_feature_points(std::string_view(whole).substr(0, size))) << size;
  }
  EXPECT_TRUE(parse_feature_points(whole));
}

TEST(FeaturePointsFile, DeepNesting_IsRefused_BeforeATreeIsBuilt) {
  const auto file = parse_feature_points(R"({"points": )" + std::string(1'000'000, '['));
  ASSERT_FALSE(file);
  EXPECT_EQ(static_cast<int>(file.error().code), static_cast<int>(ErrorCode::too_large));
}

/// Z-up to Y-up: x' = x, y' = z, z' = -y, in centimetres (0.1): (1, 2, 3) -> (0.1, 0.3, -0.2).
constexpr const char* z_up = R"({"points": {"2.1": {"vertex": 0, "position": [1, 2, 3]}},
    "to_mpeg4_axes": [[0.1, 0, 0], [0, 0, 0.1], [0, -0.1, 0]]})";

TEST(Axes, Points_AreTurned_ByTheRowsOfTheFile) {
  auto file = parse_feature_points(z_up);
  ASSERT_TRUE(file);
  change_axes(*file);
  const glm::dvec3 position = *file->points[0].position;
  EXPECT_NEAR(position.x, 0.1, 1e-12);
  EXPECT_NEAR(position.y, 0.3, 1e-12);
  EXPECT_NEAR(position.z, -0.2, 1e-12);
}

TEST(Axes, Model_IsTurned_AndToFileFrameLeadsBack) {
  const auto file = parse_feature_points(z_up);
  Model model;
  model.positions = {{1, 2, 3}};
  model.normals = {{0, 0, 1}};
  model.triangles = {{0, 1, 2}};
  change_axes(model, *file->to_mpeg4_axes);
  EXPECT_FLOAT_EQ(model.positions[0].x, 0.1F);
  EXPECT_FLOAT_EQ(model.positions[0].y, 0.3F);
  EXPECT_FLOAT_EQ(model.positions[0].z, -0.2F);
  EXPECT_NEAR(model.normals[0].y, 1.0F, 1e-6F);
  EXPECT_EQ(model.triangles[0], (Triangle{0, 1, 2}));
  const glm::vec4 back = model.to_file_frame * glm::vec4(model.positions[0], 1.0F);
  EXPECT_NEAR(back.x, 1.0F, 1e-5F);
  EXPECT_NEAR(back.y, 2.0F, 1e-5F);
  EXPECT_NEAR(back.z, 3.0F, 1e-5F);
}

TEST(Axes, Model_ThatIsMirrored_KeepsItsOutside) {
  Model model;
  model.positions = {{1, 2, 3}};
  model.triangles = {{0, 1, 2}};
  glm::dmat3 mirror(1.0);
  mirror[0][0] = -1.0;
  change_axes(model, mirror);
  EXPECT_EQ(model.triangles[0], (Triangle{0, 2, 1}));
  EXPECT_EQ(model.positions[0], glm::vec3(-1, 2, 3));
}

}  // namespace
}  // namespace semblante

// The routes without a socket: requests and responses as plain values.

#include <gtest/gtest.h>

#include "server/api/mirror_points.h"
#include "server/api/routes.h"

namespace semblante::api {
namespace {

TEST(Routes, Path_FindsItsPatternAndNames) {
  const auto match = match_route("PUT", "/v1/models/abc/feature-points");
  ASSERT_NE(match.route, nullptr);
  EXPECT_EQ(match.route->method, "PUT");
  EXPECT_EQ(match.route->pattern, "/v1/models/{model}/feature-points");
  EXPECT_EQ(match.params.at("model"), "abc");
  EXPECT_EQ(match.allow, "OPTIONS, GET, HEAD, PUT, PATCH");
  EXPECT_EQ(match_route("HEAD", "/v1/models").route, match_route("GET", "/v1/models").route);
  const auto wrong_method = match_route("PATCH", "/v1/models");
  EXPECT_EQ(wrong_method.route, nullptr);
  EXPECT_EQ(wrong_method.allow, "OPTIONS, GET, HEAD, POST");
  const auto whole_server = match_route("OPTIONS", "*");
  EXPECT_EQ(whole_server.route, nullptr);
  EXPECT_EQ(whole_server.allow, "OPTIONS, GET, HEAD, POST, PATCH, DELETE, PUT");
  for (const auto* path :
       {"/", "/v1", "/v1/models/", "/v1/models/a/b", "/v1/models//feature-points", "/healthz/x", ""}) {
    EXPECT_EQ(match_route("GET", path).route, nullptr) << path;
    EXPECT_TRUE(match_route("GET", path).allow.empty()) << path;
  }
}

TEST(Mirror, Partners_AreNearestVerticesAcrossTheMarkedMiddle) {
  // Five vertices in a row from x = 8 to x = 12; 2.1 marks the middle, x = 10.
  const std::vector<float> xyz = {8, 0, 0, 9, 0, 0, 10, 0, 0, 11.01F, 0, 0, 12, 0, 0};
  const VertexPositions positions(xyz, 4.0);
  std::vector<store::FeaturePointRecord> points = {
      {"2.1", 2, std::nullopt}, {"2.4", 1, std::nullopt}, {"3.5", std::nullopt, {{8.5, 1.0, 2.0}}}};
  fill_by_mirror(points, positions);
  ASSERT_EQ(points.size(), 5U);
  EXPECT_EQ(points[2], (store::FeaturePointRecord{"2.5", 3, std::nullopt})) << "2 * 10 - 9 = 11, next to 11.01";
  EXPECT_EQ(points[4], (store::FeaturePointRecord{"3.6", std::nullopt, {{11.5, 1.0, 2.0}}}));
}

TEST(Mirror, PartnerOnALip_GetsAVertexOnlyWhereNoOtherCouldBeMeant) {
  // 2.6 is marked at x = 1. At x = -1 both lips have a vertex; near x = -2, where the image of 8.5 is, one alone has.
  const std::vector<float> xyz = {1, 0, 0, -1, 0, 0, -1, 0, 0, 2, 0, 0, -2, 0, 0, 3, 0, 0, -3.01F, 0, 0};
  const VertexPositions positions(xyz, 10.0);
  std::vector<store::FeaturePointRecord> points = {
      {"2.6", 0, std::nullopt}, {"8.5", 3, std::nullopt}, {"8.7", 5, std::nullopt}};
  fill_by_mirror(points, positions);
  ASSERT_EQ(points.size(), 6U);
  EXPECT_EQ(points[1], (store::FeaturePointRecord{"2.7", std::nullopt, {{-1.0, 0.0, 0.0}}})) << "either lip's";
  EXPECT_EQ(points[3], (store::FeaturePointRecord{"8.6", 4, std::nullopt}));
  EXPECT_EQ(points[5], (store::FeaturePointRecord{"8.8", std::nullopt, {{-3.0, 0.0, 0.0}}})) << "not exactly there";
}

TEST(Mirror, PartnerTooFar_IsLeftOut) {
  const std::vector<float> xyz = {0, 0, 0, 1, 0, 0};
  std::vector<store::FeaturePointRecord> points = {{"2.4", 1, std::nullopt}};
  fill_by_mirror(points, VertexPositions(xyz, 1.0));  // its image is at -1: the nearest vertex is a whole diagonal away
  EXPECT_EQ(points.size(), 1U);
}

TEST(Vertices, At_TakesTheLowestOfEquals) {
  const std::vector<float> xyz = {5, 5, 5, 1, 2, 3, 1, 2, 3};
  const VertexPositions positions(xyz, 10.0);
  EXPECT_EQ(positions.at({1.0, 2.0, 3.0}), 1U);
  EXPECT_FALSE(positions.at({1.0, 2.0, 3.1}));
  EXPECT_FALSE(positions.of(3));
  EXPECT_FALSE(positions.only_one_at({1.0, 2.0, 3.0}));
  EXPECT_EQ(positions.only_one_at({5.0, 5.0, 5.0}), 0U);
}

}  // namespace
}  // namespace semblante::api

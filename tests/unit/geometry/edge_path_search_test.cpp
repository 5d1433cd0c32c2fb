#include "core/geometry/edge_path_search.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(EdgePathSearch, Strip_GoesAlongEdgesAndTheDiagonalsThatAreThere) {
  const Surface surface = build_surface(testing::make_strip(4));
  EdgePathSearch search(surface);
  const auto from_b0 = search.from(SurfaceVertexId(0));
  EXPECT_EQ(from_b0[4], 4.0);  // b4: along the bottom
  EXPECT_EQ(from_b0[5], 1.0);  // t0: up
  // t3 at (3, 1): no diagonal leads up and to the right, so 3 along and 1 up.
  EXPECT_EQ(from_b0[8], 4.0);
  // The diagonals lead from t to the b on its right: t0 -> b1 is one of them, t0 -> b4 takes it and 3 edges.
  const auto from_t0 = search.from(SurfaceVertexId(5));
  EXPECT_EQ(from_t0[1], std::sqrt(2.0));
  EXPECT_EQ(from_t0[4], std::sqrt(2.0) + 3.0);
}

TEST(EdgePathSearch, OtherPart_IsInfinitelyFar_AlsoInTheNextSearch) {
  Model model = testing::make_strip(2);
  const std::uint32_t other = testing::append(model, testing::shifted(testing::make_strip(1), {0, 0, 5}), "");
  const Surface surface = build_surface(model);
  EdgePathSearch search(surface);
  EXPECT_EQ(search.from(SurfaceVertexId(0))[other], infinite);
  const auto distances = search.from(SurfaceVertexId(other));
  EXPECT_EQ(distances[other + 1], 1.0);
  EXPECT_EQ(distances[0], infinite);  // what the first search left must be gone
}

TEST(EdgePathSearch, EdgeWithoutLength_CostsNothing) {
  // 1 and 2 lie at one place, joined by the inner edge of two triangles without area.
  const Surface surface =
      build_surface(testing::make_model({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}},
                                        {{0, 1, 2}, {1, 3, 2}, {0, 4, 1}, {1, 4, 3}, {0, 2, 5}, {2, 3, 5}}));
  ASSERT_EQ(surface.vertex_count(), 6U);
  EdgePathSearch search(surface);
  const auto distances = search.from(SurfaceVertexId(4));
  EXPECT_EQ(distances[1], 1.0);
  EXPECT_EQ(distances[2], 1.0);
  EXPECT_EQ(distances[5], 2.0);  // straight through
}

TEST(EdgePathSearch, SeveralSources_TheNearestCounts) {
  const Surface surface = build_surface(testing::make_strip(4));
  EdgePathSearch search(surface);
  const std::vector<SurfaceVertexId> sources = {SurfaceVertexId(0), SurfaceVertexId(4)};
  const auto distances = search.from(sources);
  EXPECT_EQ(distances[0], 0.0);
  EXPECT_EQ(distances[1], 1.0);
  EXPECT_EQ(distances[2], 2.0);
  EXPECT_EQ(distances[3], 1.0);
}

TEST(EdgePathSearch, NoSource_EverythingInfinitelyFar) {
  const Surface surface = build_surface(testing::make_strip(1));
  EdgePathSearch search(surface);
  (void)search.from(SurfaceVertexId(0));
  for (const double d : search.from(std::span<const SurfaceVertexId>())) EXPECT_EQ(d, infinite);
}

TEST(EdgePathSearch, VertexWithoutTriangles_ReachesOnlyItself) {
  Model model = testing::make_strip(1);
  model.positions.emplace_back(7, 7, 7);
  const Surface surface = build_surface(model);
  EdgePathSearch search(surface);
  const auto distances = search.from(SurfaceVertexId(4));
  EXPECT_EQ(distances[4], 0.0);
  EXPECT_EQ(distances[0], infinite);
}

}  // namespace
}  // namespace semblante

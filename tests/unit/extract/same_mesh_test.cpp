#include "core/extract/same_mesh.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

TEST(SameMesh, TakesTheSameFaces_InAnyOrder) {
  const Model grid = testing::make_grid(12, 10);
  EXPECT_TRUE(check_same_mesh(grid.triangles, grid.triangles));
  auto turned = grid.triangles;
  std::reverse(turned.begin(), turned.end());
  for (Triangle& triangle : turned) std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
  EXPECT_TRUE(check_same_mesh(grid.triangles, turned));
}

TEST(SameMesh, TakesNoFaces) { EXPECT_TRUE(check_same_mesh(testing::make_grid(2, 2).triangles, {})); }

// (a b c)(a c d) as (a b d)(b c d): four of five edges stay.
TEST(SameMesh, TakesQuadsSplitAlongTheOtherDiagonal) {
  const Model grid = testing::make_grid(8, 8);
  std::vector<Triangle> other;
  for (std::uint32_t row = 0; row < 8; ++row) {
    for (std::uint32_t column = 0; column < 8; ++column) {
      const std::uint32_t a = 9 * row + column, b = a + 1, c = a + 10, d = a + 9;
      const bool rising = std::any_of(grid.triangles.begin(), grid.triangles.end(), [&](const Triangle& t) {
        return std::count(t.begin(), t.end(), a) == 1 && std::count(t.begin(), t.end(), c) == 1;
      });
      if (rising) {
        other.push_back({a, b, d});
        other.push_back({b, c, d});
      } else {
        other.push_back({a, b, c});
        other.push_back({a, c, d});
      }
    }
  }
  EXPECT_TRUE(check_same_mesh(grid.triangles, other));
}

TEST(SameMesh, RefusesVerticesInAnotherOrder) {
  const Model grid = testing::make_grid(12, 10);
  std::vector<std::uint32_t> order(grid.positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), std::mt19937(7));
  auto shuffled = grid.triangles;
  for (Triangle& triangle : shuffled) {
    for (std::uint32_t& vertex : triangle) vertex = order[vertex];
  }
  const Status status = check_same_mesh(grid.triangles, shuffled);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::mismatch);
  EXPECT_NE(status.error().message.find("another order"), std::string::npos);
}

}  // namespace
}  // namespace semblante

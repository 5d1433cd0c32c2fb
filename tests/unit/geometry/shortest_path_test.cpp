#include "core/geometry/shortest_path.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/geometry/edge_path_search.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

TEST(ShortestPath, IsAsLongAsTheDistanceAndGoesAlongEdges) {
  const Surface surface = build_surface(testing::make_grid(9, 7));
  EdgePathSearch search(surface);
  for (const auto& [from, to] : {std::pair(3U, 61U), std::pair(0U, 79U), std::pair(40U, 41U)}) {
    const auto path = shortest_path(surface, SurfaceVertexId(from), SurfaceVertexId(to));
    ASSERT_GE(path.size(), 2U);
    EXPECT_EQ(path.front(), SurfaceVertexId(from));
    EXPECT_EQ(path.back(), SurfaceVertexId(to));
    double length = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) {
      bool is_step = false;
      for (const Surface::Step& step : surface.steps_from(path[i - 1])) is_step |= step.to == path[i];
      EXPECT_TRUE(is_step);
      length += glm::distance(surface.positions[path[i - 1].value()], surface.positions[path[i].value()]);
    }
    EXPECT_NEAR(length, search.from(SurfaceVertexId(from))[to], 1e-9);
  }
}

TEST(ShortestPath, ToItselfIsOneVertex) {
  const Surface surface = build_surface(testing::make_grid(2, 2));
  EXPECT_EQ(shortest_path(surface, SurfaceVertexId(4), SurfaceVertexId(4)), std::vector{SurfaceVertexId(4)});
}

TEST(ShortestPath, IsEmptyBetweenParts) {
  Model model = testing::make_grid(2, 2);
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  for (const glm::vec3& p : {glm::vec3(9, 0, 0), glm::vec3(10, 0, 0), glm::vec3(9, 1, 0)}) model.positions.push_back(p);
  model.triangles.push_back({first, first + 1, first + 2});
  const Surface surface = build_surface(model);
  EXPECT_TRUE(shortest_path(surface, SurfaceVertexId(0), surface.surface_of[first]).empty());
}

}  // namespace
}  // namespace semblante

#include "core/geometry/shortest_path.h"

#include <algorithm>
#include <cmath>
#include <optional>

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

/// The expected path, from the distances of all vertices of the part: it is followed backwards from `to`; of several
/// predecessors on shortest paths the one with the least vertex number is taken.
std::vector<SurfaceVertexId> path_by_distances(const Surface& surface, SurfaceVertexId from, SurfaceVertexId to) {
  EdgePathSearch search(surface);
  const std::span<const double> distances = search.from(from);
  std::vector<SurfaceVertexId> path = {to};
  while (path.back() != from) {
    std::optional<SurfaceVertexId> before;
    for (const Surface::Step& step : surface.steps_from(path.back())) {
      if (distances[step.to.value()] + step.length != distances[path.back().value()]) continue;
      if (!before || step.to.value() < before->value()) before = step.to;
    }
    if (!before) return {};
    path.push_back(*before);
  }
  std::reverse(path.begin(), path.end());
  return path;
}

// A flat grid has many paths of one length, a wavy one hardly two.
TEST(ShortestPath, IsThatOfASearchOfTheWholePart) {
  for (const float height : {0.0F, 0.7F}) {
    Model model = testing::make_grid(12, 10);
    for (glm::vec3& p : model.positions) p.z = height * std::sin(1.7F * p.x + p.y * p.y);
    const Surface surface = build_surface(model);
    for (std::uint32_t from = 0; from < 143; from += 11) {
      for (std::uint32_t to = 0; to < 143; to += 5) {
        const SurfaceVertexId a(from);
        const SurfaceVertexId b(to);
        EXPECT_EQ(shortest_path(surface, a, b), path_by_distances(surface, a, b)) << from << " to " << to;
      }
    }
  }
}

TEST(ShortestPath, LeadsAroundVerticesThatCostMore_IfThatIsCheaper) {
  const Surface surface = build_surface(testing::make_grid(4, 4));  // rows of five
  const SurfaceVertexId from(10);
  const SurfaceVertexId to(14);
  const auto middle_row_costs = [&](double cost) {
    return shortest_path(surface, from, to,
                         [cost](SurfaceVertexId v) { return v.value() > 10 && v.value() < 14 ? cost : 1.0; });
  };
  EXPECT_EQ(middle_row_costs(1.0), shortest_path(surface, from, to));
  EXPECT_EQ(middle_row_costs(1.2), shortest_path(surface, from, to));
  for (const SurfaceVertexId v : middle_row_costs(4.0)) EXPECT_FALSE(v.value() > 10 && v.value() < 14) << v.value();
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

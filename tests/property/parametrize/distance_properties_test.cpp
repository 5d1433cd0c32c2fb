// The surface distance is a metric, never shorter than the straight line.

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/geometry/edge_path_search.h"
#include "tests/property/parametrize/random_head.h"

namespace semblante {
namespace {

TEST(DistanceProperties, IsAMetricAboveTheStraightLine) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Model model = testing::make_landscape(random, 10, 64, {true, true, true, true, true});
    const Surface surface = build_surface(model);
    EdgePathSearch search(surface);
    const std::size_t count = surface.vertex_count();
    std::vector<std::vector<double>> d(count);
    for (std::uint32_t s = 0; s < count; ++s) {
      const auto from = search.from(SurfaceVertexId(s));
      d[s].assign(from.begin(), from.end());
    }
    std::uniform_int_distribution<std::size_t> any(0, count - 1);
    for (int trial = 0; trial < 20000; ++trial) {
      const std::size_t a = any(random);
      const std::size_t b = any(random);
      const std::size_t c = any(random);
      ASSERT_EQ(d[a][a], 0.0);
      const bool reachable = surface.part_of[a] == surface.part_of[b] &&
                             (a == b || !surface.steps_from(SurfaceVertexId(static_cast<std::uint32_t>(a))).empty());
      ASSERT_EQ(std::isfinite(d[a][b]), reachable);
      if (!reachable) continue;
      ASSERT_NEAR(d[a][b], d[b][a], 1e-12 * d[a][b]);
      ASSERT_GE(d[a][b] * (1 + 1e-12), glm::distance(surface.positions[a], surface.positions[b]));
      if (std::isfinite(d[b][c])) {
        ASSERT_LE(d[a][c], (d[a][b] + d[b][c]) * (1 + 1e-12));
      }
    }
  }
}

}  // namespace
}  // namespace semblante

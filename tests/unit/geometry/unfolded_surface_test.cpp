#include "core/geometry/unfolded_surface.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/geometry/edge_path_search.h"
#include "tests/oracle/steiner_distances.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

std::vector<double> distances(const Surface& graph, std::uint32_t source) {
  EdgePathSearch search(graph);
  const auto found = search.from(SurfaceVertexId(source));
  return {found.begin(), found.end()};
}

struct Overestimate {
  double mean = 0.0;
  double greatest = 0.0;
  double least = 1e9;
};

template <class Exact>
Overestimate overestimate(const std::vector<double>& found, Exact exact) {
  Overestimate result;
  std::size_t count = 0;
  for (std::uint32_t v = 0; v < found.size(); ++v) {
    const double truth = exact(v);
    if (!(truth > 0.0)) continue;
    const double excess = found[v] / truth - 1.0;
    result.mean += excess;
    result.greatest = std::max(result.greatest, excess);
    result.least = std::min(result.least, excess);
    ++count;
  }
  result.mean /= static_cast<double>(count);
  return result;
}

/// A flat grid whose inner vertices are shaken: in a convex flat piece the geodesic is the straight line.
Model shaken_grid(std::uint32_t side) {
  Model model = testing::make_grid(side, side);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> shake(-0.25F, 0.25F);
  for (glm::vec3& p : model.positions) {
    if (p.x == 0.0F || p.y == 0.0F || p.x == static_cast<float>(side) || p.y == static_cast<float>(side)) continue;
    // One statement each: compilers evaluate the arguments of a call in different orders.
    const float y = shake(random);
    const float x = shake(random);
    p += glm::vec3(x, y, 0.0F);
  }
  return model;
}

//     t0---t1
//     |  \  |      the diagonal b0-t1 has length sqrt(2) once laid flat, whatever the fold
//     b0---b1
TEST(UnfoldedSurface_Diagonal, HasTheLengthOfTheSquareLaidFlat) {
  for (const float fold : {0.0F, 0.5F, 2.0F}) {
    Model model = testing::make_strip(1);  // b0 0, b1 1, t0 2, t1 3; the common edge is t0-b1
    const glm::vec3 out(0.0F, 0.0F, std::sin(fold));
    const glm::vec3 middle(0.5F, 0.5F, 0.0F);
    model.positions[3] = middle + std::cos(fold) * (model.positions[3] - middle) + std::sqrt(0.5F) * out;
    const Surface surface = build_surface(model);

    const Surface unfolded = with_unfolded_diagonals(surface, model.triangles);

    EXPECT_NEAR(distances(surface, 0)[3], 2.0, 1e-6);
    EXPECT_NEAR(distances(unfolded, 0)[3], std::sqrt(2.0), 1e-6);
  }
}

// Laid flat, the straight way from a to d passes outside the common edge b-c: there is no diagonal.
TEST(UnfoldedSurface_Diagonal, IsLeftOutWhereItLeavesTheTriangles) {
  const Model model = testing::make_model({{0, 0, 0}, {1, 1, 0}, {1, 2, 0}, {2, 0, 0}}, {{0, 1, 2}, {1, 3, 2}});
  const Surface surface = build_surface(model);

  const Surface unfolded = with_unfolded_diagonals(surface, model.triangles);

  EXPECT_EQ(unfolded.steps.size(), surface.steps.size());
}

TEST(UnfoldedSurface_Diagonal, TakesEveryPairOfTrianglesAtAnEdgeOfThree) {
  const Model model = testing::make_model({{0, 0, 0}, {0, 1, 0}, {1, 0.5F, 0}, {-1, 0.5F, 0}, {0, 0.5F, 1}},
                                          {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 1, 4}});
  const Surface surface = build_surface(model);

  const Surface unfolded = with_unfolded_diagonals(surface, model.triangles);

  EXPECT_EQ(unfolded.steps.size(), surface.steps.size() + 6);  // 2-3, 2-4, 3-4, from either end
  EXPECT_NEAR(distances(unfolded, 2)[4], 2.0, 1e-12);
}

TEST(UnfoldedSurface_Distances, AreNearTheStraightLineOnAFlatPiece) {
  const Model model = shaken_grid(30);
  const Surface surface = build_surface(model);
  const std::uint32_t source = 15 * 31 + 15;
  const auto straight = [&](std::uint32_t v) {
    return static_cast<double>(glm::distance(glm::dvec3(model.positions[v]), glm::dvec3(model.positions[source])));
  };

  const Overestimate edge = overestimate(distances(surface, source), straight);
  const Overestimate unfolded =
      overestimate(distances(with_unfolded_diagonals(surface, model.triangles), source), straight);

  EXPECT_GE(unfolded.least, -1e-9);  // never shorter than the geodesic
  EXPECT_LE(unfolded.mean, 0.025);
  EXPECT_LE(unfolded.mean, edge.mean / 2.0);
}

TEST(UnfoldedSurface_Distances, AreNearTheExactOnesOnABall) {
  const Model model = testing::make_ball({0, 0, 0}, 1.0F, 24, 14);
  const Surface surface = build_surface(model);
  const oracle::SteinerDistances exact(surface.positions, model.triangles, surface.surface_of, 12);
  const std::vector<double> truth = exact.from(40);

  const Overestimate unfolded = overestimate(distances(with_unfolded_diagonals(surface, model.triangles), 40),
                                             [&](std::uint32_t v) { return truth[v]; });

  EXPECT_GE(unfolded.least, -0.002);  // the oracle's own excess
  EXPECT_LE(unfolded.mean, 0.025);
  EXPECT_LE(unfolded.greatest, 0.10);  // against the squares' only diagonal: 1 / cos(22.5 deg) - 1 = 0.082 on flat ones
}

// The oracle against closed forms: a flat square, and a box, whose sides unroll.
TEST(SteinerDistances_Excess, IsSmallWhereTheGeodesicIsKnown) {
  const Model grid = shaken_grid(12);
  const Surface flat = build_surface(grid);
  const auto on_grid = oracle::SteinerDistances(flat.positions, grid.triangles, flat.surface_of, 12).from(0);
  for (std::uint32_t v = 1; v < on_grid.size(); ++v) {
    const double straight = glm::distance(flat.positions[v], flat.positions[0]);
    EXPECT_GE(on_grid[v], straight * (1.0 - 1e-9));
    EXPECT_LE(on_grid[v], straight * 1.004);
  }
  const Model box = testing::make_box({0, 0, 0}, {1, 1, 1});
  const Surface sides = build_surface(box);
  const auto on_box = oracle::SteinerDistances(sides.positions, box.triangles, sides.surface_of, 12).from(0);
  double farthest = 0.0;
  for (std::uint32_t v = 0; v < on_box.size(); ++v) farthest = std::max(farthest, on_box[v]);
  EXPECT_NEAR(farthest, std::sqrt(5.0), 0.01);  // opposite corners: two sides laid flat are 1 by 2
}

}  // namespace
}  // namespace semblante

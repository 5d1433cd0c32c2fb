// All sources at once must give the very bits of one search per source, with every kind of register this machine has.
#include "core/geometry/distances_from_all.h"

#include <bit>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/geometry/edge_path_search.h"
#include "core/geometry/unfolded_surface.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

std::vector<SurfaceVertexId> pick_sources(std::mt19937& random, std::span<const SurfaceVertexId> members,
                                          std::size_t count) {
  std::uniform_int_distribution<std::size_t> any(0, members.size() - 1);
  std::vector<SurfaceVertexId> sources;
  for (std::size_t i = 0; i < count; ++i) sources.push_back(members[any(random)]);
  return sources;
}

void expect_bits_of_single_searches(const Surface& graph, PartId part, std::span<const SurfaceVertexId> sources) {
  const auto members = graph.members_of(part);
  EdgePathSearch search(graph);
  std::vector<std::vector<double>> expected;
  for (const SurfaceVertexId source : sources) {
    const auto found = search.from(source);
    expected.emplace_back(found.begin(), found.end());
  }
  for (const DistanceKernel& kernel : distance_kernels()) {
    SCOPED_TRACE(kernel.name);
    const DistancesFromAll all = distances_from_all(graph, part, sources, kernel);
    std::vector<double> row(sources.size());
    for (std::size_t m = 0; m < members.size(); ++m) {
      all.read_row(m, row);
      for (std::size_t i = 0; i < sources.size(); ++i) {
        const auto wanted = std::bit_cast<std::uint64_t>(expected[i][members[m].value()]);
        ASSERT_EQ(std::bit_cast<std::uint64_t>(row[i]), wanted) << "source " << i << ", member " << m;
        ASSERT_EQ(std::bit_cast<std::uint64_t>(all.at(i, m)), wanted);
      }
    }
  }
}

Model make_hills(std::mt19937& random, std::uint32_t side) {
  Model model = testing::make_grid(side, side);
  std::uniform_real_distribution<float> shake(-0.4F, 0.4F);
  for (glm::vec3& p : model.positions) {
    p.z = 3.0F * std::sin(0.7F * p.x) * std::cos(0.5F * p.y);
    p += glm::vec3(shake(random), shake(random), shake(random));
  }
  return model;
}

TEST(DistancesFromAll, Hills_EqualSingleSearchesBitForBit) {
  std::mt19937 random(7);
  const Surface surface = build_surface(make_hills(random, 40));
  for (const std::size_t count : {1U, 7U, 8U, 9U, 83U}) {
    SCOPED_TRACE(count);
    expect_bits_of_single_searches(surface, PartId(0), pick_sources(random, surface.members_of(PartId(0)), count));
  }
}

TEST(DistancesFromAll, UnfoldedDiagonals_EqualSingleSearchesBitForBit) {
  std::mt19937 random(11);
  const Model model = make_hills(random, 30);
  const Surface surface = build_surface(model);
  const Surface unfolded = with_unfolded_diagonals(surface, model.triangles);
  expect_bits_of_single_searches(unfolded, PartId(0), pick_sources(random, surface.members_of(PartId(0)), 20));
}

TEST(DistancesFromAll, FoldedSnake_StraightDistanceMisleadsTheOrder_NotTheResult) {
  std::mt19937 random(3);
  Model model = testing::make_strip(400);
  for (glm::vec3& p : model.positions) {
    const float along = p.x;
    p = glm::vec3(20.0F * std::sin(along * 0.3F), along * 0.05F, p.y + std::cos(along * 0.3F));
  }
  const Surface surface = build_surface(model);
  expect_bits_of_single_searches(surface, PartId(0), pick_sources(random, surface.members_of(PartId(0)), 16));
}

TEST(DistancesFromAll, CrumpledBand_NoOrderSuits_EqualsSingleSearches) {
  std::mt19937 random(13);
  Model model = testing::make_strip(4000);
  std::uniform_real_distribution<float> anywhere(-1.0F, 1.0F);
  for (glm::vec3& p : model.positions) p = glm::vec3(anywhere(random), anywhere(random), anywhere(random));
  const Surface surface = build_surface(model);
  expect_bits_of_single_searches(surface, PartId(0), pick_sources(random, surface.members_of(PartId(0)), 9));
}

TEST(DistancesFromAll, SecondPartAndVertexWithoutTriangles_OnlyTheirOwnMembers) {
  Model model = testing::make_strip(3);
  testing::append(model, testing::shifted(testing::make_ball({0, 0, 0}, 1.0F), {20, 0, 0}), "ball");
  model.positions.emplace_back(50.0F, 0.0F, 0.0F);
  const Surface surface = build_surface(model);
  std::mt19937 random(5);
  for (std::uint32_t p = 0; p < surface.part_count(); ++p) {
    expect_bits_of_single_searches(surface, PartId(p), pick_sources(random, surface.members_of(PartId(p)), 10));
  }
}

TEST(DistancesFromAll, AllAtOnePlace_EdgesWithoutLength) {
  Model model = testing::make_grid(4, 4);
  for (glm::vec3& p : model.positions) p = glm::vec3(1.0F);
  const Surface surface = build_surface(model);
  std::mt19937 random(5);
  expect_bits_of_single_searches(surface, PartId(0), pick_sources(random, surface.members_of(PartId(0)), 10));
}

TEST(DistancesFromAll, NoSource_NoDistances) {
  const Surface surface = build_surface(testing::make_strip(2));
  const DistancesFromAll all = distances_from_all(surface, PartId(0), {});
  std::vector<double> row;
  all.read_row(0, row);
  EXPECT_TRUE(row.empty());
}

}  // namespace
}  // namespace semblante

#include "core/anatomy/cavities.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/sample_head_model.h"

namespace semblante {
namespace {

constexpr std::uint32_t side = 40;
constexpr std::uint32_t at(std::uint32_t column, std::uint32_t row) { return row * (side + 1) + column; }
using testing::Marks;
using testing::with;

/// A mouth in the middle of a grid, and the chin: paths along the rim stay near to a rectangle.
Marks mouth_and_chin() {
  return {{"2.4", at(30, 20)}, {"2.5", at(10, 20)}, {"2.6", at(28, 28)}, {"2.7", at(12, 28)},
          {"2.8", at(28, 12)}, {"2.9", at(12, 12)}, {"2.1", at(20, 3)}};
}

std::vector<Cavity> cavities_of(const Marks& marks) {
  const Model model = testing::make_grid(side, side);
  const Surface surface = build_surface(model);
  return find_cavities(surface, PartId(0), surface_points(surface, testing::points_at(model, marks)));
}

bool holds(const Cavity& cavity, std::uint32_t vertex) {
  return std::binary_search(cavity.members.begin(), cavity.members.end(), SurfaceVertexId(vertex));
}

TEST(Cavities, LieBehindTheRimAndWithoutIt) {
  const auto cavities = cavities_of(mouth_and_chin());

  ASSERT_EQ(cavities.size(), 1U);
  EXPECT_TRUE(cavities[0].is_mouth);
  EXPECT_TRUE(holds(cavities[0], at(20, 20)));
  EXPECT_FALSE(holds(cavities[0], at(20, 28)));
  EXPECT_FALSE(holds(cavities[0], at(20, 35)));
  EXPECT_FALSE(holds(cavities[0], at(2, 2)));
}

TEST(Cavities, NeedARimOfBothLipsAndAPointBesideIt) {
  EXPECT_TRUE(cavities_of({{"2.4", at(30, 20)}, {"2.5", at(10, 20)}, {"2.2", at(20, 28)}, {"2.1", at(20, 3)}}).empty());
  EXPECT_TRUE(cavities_of({{"2.4", at(30, 20)}, {"2.2", at(20, 28)}, {"2.3", at(20, 12)}, {"2.1", at(20, 3)}}).empty());
  EXPECT_TRUE(
      cavities_of({{"2.4", at(30, 20)}, {"2.5", at(10, 20)}, {"2.2", at(20, 28)}, {"2.3", at(20, 12)}}).empty());
}

// A tongue that is a part of the skin moves by its own points.
TEST(Cavities, AreNoneWithAPointInside) {
  EXPECT_TRUE(cavities_of(with(mouth_and_chin(), {{"6.1", at(20, 20)}})).empty());
}

// A guessed point of the outer lip may be at a vertex behind the rim; that does not make the inside a front.
TEST(Cavities, HoldAPointOfTheLipsThatIsBehindTheRim) {
  const auto cavities = cavities_of(with(mouth_and_chin(), {{"8.6", at(13, 25)}}));
  ASSERT_EQ(cavities.size(), 1U);
  EXPECT_TRUE(holds(cavities[0], at(20, 20)));
  EXPECT_FALSE(holds(cavities[0], at(20, 35)));
}

TEST(Cavities, OfTheSampleHeadAreItsMouthBehindTheLips) {
  const Surface surface = build_surface(testing::sample_head_model());
  const auto points = surface_points(surface, testing::sample_head_points());
  const auto chin = std::find_if(points.begin(), points.end(),
                                 [](const SurfacePoint& p) { return p.id == parse_feature_point("2.1"); });
  const auto cavities = find_cavities(surface, surface.part_of[chin->vertex.value()], points);

  const auto mouth =
      std::find_if(cavities.begin(), cavities.end(), [](const Cavity& cavity) { return cavity.is_mouth; });
  ASSERT_NE(mouth, cavities.end());
  for (const SurfacePoint& p : points) EXPECT_FALSE(holds(*mouth, p.vertex.value())) << to_string(p.id);
}

// With ES0 of 16 cells the thickness of a lip is 2.4 of them.
TEST(InsideOfMouth, BeginsBehindTheThicknessOfALip) {
  const Model model = testing::make_grid(side, side);
  const Surface surface = build_surface(model);
  const auto points = surface_points(surface, testing::points_at(model, mouth_and_chin()));
  std::vector<Part> parts(1);
  parts[0].role = PartRole::skin;
  const double cell = glm::distance(model.positions[at(1, 0)], model.positions[at(0, 0)]);
  const std::vector<bool> inside = inside_of_mouth(surface, parts, points, 16.0 * cell);

  ASSERT_EQ(inside.size(), surface.vertex_count());
  EXPECT_TRUE(inside[at(20, 20)]);
  EXPECT_TRUE(inside[at(20, 25)]);
  EXPECT_FALSE(inside[at(20, 26)]);
  EXPECT_FALSE(inside[at(20, 35)]);
  parts[0].role = PartRole::body;
  EXPECT_TRUE(inside_of_mouth(surface, parts, points, 16.0 * cell).empty());
}

TEST(JawShareInMouth, FallsToTheRoofAndToTheHinge) {
  EXPECT_GT(jaw_share_in_mouth({0.0, -0.4, -0.1}), 0.8);
  EXPECT_EQ(jaw_share_in_mouth({0.0, 0.3, -0.1}), 0.0);
  EXPECT_EQ(jaw_share_in_mouth({0.0, -0.4, -1.4}), 0.0);
  EXPECT_GT(jaw_share_in_mouth({0.0, -0.2, -0.3}), jaw_share_in_mouth({0.0, 0.0, -0.3}));
  EXPECT_GT(jaw_share_in_mouth({0.0, -0.2, -0.3}), jaw_share_in_mouth({0.0, -0.2, -0.6}));
}

}  // namespace
}  // namespace semblante

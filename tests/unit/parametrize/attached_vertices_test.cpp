#include "core/parametrize/attached_vertices.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

/// The slit of a plate as the eye, and a strip of five columns that begins at its upper rim and lies close upon the
/// plate, from row to row `row_height` apart.
struct EyeWithStrip {
  testing::ClosedMouth plate = testing::make_closed_mouth();
  std::uint32_t first = 0;
  static constexpr std::uint32_t columns = 5;
  static constexpr std::uint32_t rows = 4;

  /// y of the followed vertex, by row of the middle column.
  std::vector<float> heights_followed(float from) {
    std::vector<glm::vec3> positions;
    std::vector<Triangle> triangles;
    for (std::uint32_t r = 0; r < rows; ++r) {
      for (std::uint32_t c = 0; c < columns; ++c)
        positions.emplace_back(static_cast<float>(c) - 2.0F, from + static_cast<float>(r), 0.05F);
    }
    for (std::uint32_t r = 0; r + 1 < rows; ++r) {
      for (std::uint32_t c = 0; c + 1 < columns; ++c) {
        const std::uint32_t a = r * columns + c;
        triangles.push_back({a, a + 1, a + columns});
        triangles.push_back({a + 1, a + columns + 1, a + columns});
      }
    }
    Model model = plate.model;
    first = testing::append(model, testing::make_model(positions, triangles), "strip");
    const Surface surface = build_surface(model);
    const auto points = surface_points(surface, testing::points_at(model, {{"3.11", plate.at(-2, 0)},
                                                                           {"3.7", plate.at(2, 0)},
                                                                           {"3.1", plate.at(0, 0, true)},
                                                                           {"3.3", plate.at(0, 0, false)}}));
    std::vector<Part> parts(surface.part_count());
    parts[surface.part_of[surface.surface_of[0].value()].value()].role = PartRole::skin;
    parts[surface.part_of[surface.surface_of[first].value()].value()].role = PartRole::attached;
    const auto followed = followed_by_attached(surface, parts, points);
    EXPECT_TRUE(followed[surface.surface_of[0].value()].empty()) << "the skin itself follows nothing";
    std::vector<float> heights;
    for (std::uint32_t r = 0; r < rows; ++r) {
      float height = 0.0F;
      float sum = 0.0F;
      for (const auto& [vertex, share] : followed[surface.surface_of[first + r * columns + 2].value()]) {
        height += static_cast<float>(share) * static_cast<float>(surface.positions[vertex.value()].y);
        sum += static_cast<float>(share);
      }
      EXPECT_FLOAT_EQ(sum, 1.0F);
      heights.push_back(height);
    }
    return heights;
  }
};

TEST(AttachedVertices, LashThatLiesOnTheLid_FollowsTheEdge) {
  EXPECT_EQ(EyeWithStrip().heights_followed(0.1F), std::vector<float>({0, 0, 0, 0}));
}

TEST(AttachedVertices, BrowThatLiesOnTheSkin_FollowsWhatIsUnderIt) {
  // Two of four units of the eye's width away from its edge.
  EXPECT_EQ(EyeWithStrip().heights_followed(1.1F), std::vector<float>({1, 2, 3, 4}));
}

}  // namespace
}  // namespace semblante

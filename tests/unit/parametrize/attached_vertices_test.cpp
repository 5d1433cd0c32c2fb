#include "core/parametrize/attached_vertices.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

constexpr std::uint32_t strip_columns = 5;

/// A strip of five columns in front of the middle of the plate.
Model make_strip(std::uint32_t rows, const glm::vec3& middle_of_first_row, float row_height) {
  std::vector<glm::vec3> positions;
  std::vector<Triangle> triangles;
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < strip_columns; ++c)
      positions.push_back(middle_of_first_row +
                          glm::vec3(static_cast<float>(c) - 2.0F, row_height * static_cast<float>(r), 0.0F));
  }
  for (std::uint32_t r = 0; r + 1 < rows; ++r) {
    for (std::uint32_t c = 0; c + 1 < strip_columns; ++c) {
      const std::uint32_t a = r * strip_columns + c;
      triangles.push_back({a, a + 1, a + strip_columns});
      triangles.push_back({a + 1, a + strip_columns + 1, a + strip_columns});
    }
  }
  return testing::make_model(positions, triangles);
}

std::vector<SurfacePoint> points_of_eye(const Surface& surface, const Model& model, const testing::ClosedMouth& plate) {
  return surface_points(surface, testing::points_at(model, {{"3.11", plate.at(-2, 0)},
                                                            {"3.7", plate.at(2, 0)},
                                                            {"3.1", plate.at(0, 0, true)},
                                                            {"3.3", plate.at(0, 0, false)}}));
}

/// The slit of a plate as the eye, and a strip that begins at its upper rim and lies close upon the plate.
struct EyeWithStrip {
  testing::ClosedMouth plate = testing::make_closed_mouth();
  std::uint32_t first = 0;
  static constexpr std::uint32_t rows = 4;

  /// y of the followed vertex, by row of the middle column.
  std::vector<float> heights_followed(float from) {
    Model model = plate.model;
    first = testing::append(model, make_strip(rows, {0.0F, from, 0.05F}, 1.0F), "strip");
    const Surface surface = build_surface(model);
    const auto points = points_of_eye(surface, model, plate);
    std::vector<Part> parts(surface.part_count());
    parts[surface.part_of[surface.surface_of[0].value()].value()].role = PartRole::skin;
    parts[surface.part_of[surface.surface_of[first].value()].value()].role = PartRole::attached;
    const auto followed = followed_by_attached(surface, parts, points);
    EXPECT_TRUE(followed[surface.surface_of[0].value()].empty()) << "the skin itself follows nothing";
    std::vector<float> heights;
    for (std::uint32_t r = 0; r < rows; ++r) {
      float height = 0.0F;
      float sum = 0.0F;
      for (const auto& [vertex, share] : followed[surface.surface_of[first + r * strip_columns + 2].value()]) {
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

// A closed eye whose upper lid lies over the lower one. Both lashes hang down over the lower lid, and most vertices of
// the lower lid's are nearer to the edge of the upper lid than to that of their own.
TEST(AttachedVertices, LashesOfAClosedEye_FollowTheirOwnLids) {
  constexpr std::uint32_t rows = 3;
  testing::ClosedMouth plate = testing::make_closed_mouth();
  const auto on_rim = [&plate](bool upper) {
    return std::array{plate.at(-1, 0, upper), plate.at(0, 0, upper), plate.at(1, 0, upper)};
  };
  for (const std::uint32_t v : on_rim(true)) plate.model.positions[v] += glm::vec3(0.0F, -0.1F, 0.1F);
  Model model = plate.model;
  const std::uint32_t upper = testing::append(model, make_strip(rows, {0.0F, -0.12F, 0.12F}, -0.2F), "upper lash");
  const std::uint32_t lower = testing::append(model, make_strip(rows, {0.0F, 0.0F, 0.02F}, -0.2F), "lower lash");
  const Surface surface = build_surface(model);
  std::vector<Part> parts(surface.part_count());
  parts[surface.part_of[surface.surface_of[0].value()].value()].role = PartRole::skin;
  for (const std::uint32_t first : {upper, lower})
    parts[surface.part_of[surface.surface_of[first].value()].value()].role = PartRole::attached;
  const auto followed = followed_by_attached(surface, parts, points_of_eye(surface, model, plate));
  for (const bool is_upper : {true, false}) {
    for (std::uint32_t r = 0; r < rows; ++r) {
      // Only the middle column is compared: the other columns are as near to the corners, which both lids share.
      const auto& row = followed[surface.surface_of[(is_upper ? upper : lower) + r * strip_columns + 2].value()];
      EXPECT_FALSE(row.empty());
      for (const FollowedVertex& f : row) {
        const std::uint32_t file_vertex = surface.file_vertex_of[f.vertex.value()].value();
        const auto other = on_rim(!is_upper);
        EXPECT_EQ(std::find(other.begin(), other.end(), file_vertex), other.end())
            << (is_upper ? "upper" : "lower") << " lash, row " << r;
      }
    }
  }
}

}  // namespace
}  // namespace semblante

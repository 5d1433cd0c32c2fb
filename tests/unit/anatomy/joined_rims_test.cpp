#include "core/anatomy/joined_rims.h"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/sample_head_model.h"

namespace semblante {
namespace {

FeaturePointId id_of(const char* name) { return parse_feature_point(name).value(); }

/// A sheet that faces forward, rows of vertices at y = 0, 1, 2 and 3, two units wide. 3.1 lies on the row y = 2; the
/// row below it has `middle` of 3.1's weight.
class SheetUnderALid {
 public:
  explicit SheetUnderALid(float middle) {
    for (std::uint32_t y = 0; y < 4; ++y) {
      for (std::uint32_t x = 0; x < 3; ++x) {
        model.positions.emplace_back(x, y, 0.0F);
        const float weight = y == 2 ? 1.0F : y == 1 ? middle : 0.0F;
        if (weight > 0.0F) rig.influence.push(id_of("3.1"), weight);
        rig.influence.end_row();
      }
    }
    for (std::uint32_t y = 0; y < 3; ++y) {
      for (std::uint32_t x = 0; x < 2; ++x) {
        const std::uint32_t v = 3 * y + x;
        model.triangles.push_back({v, v + 1, v + 4});
        model.triangles.push_back({v, v + 4, v + 3});
      }
    }
    rig.parts.emplace_back().role = PartRole::skin;
    rig.part_of_vertex.assign(model.positions.size(), PartId(0));
  }

  Model model;
  Rig rig;
};

Heights lid_by(double height) {
  Heights heights{};
  heights[id_of("3.1").value()] = height;
  return heights;
}

// The rows y = 0, 1, 2 come to one line.
TEST(ShareBeforeFold, EvenWeights_CloseCompletely) {
  const SheetUnderALid sheet(0.5F);
  EXPECT_EQ(share_before_fold(sheet.model, sheet.rig, lid_by(-2.0)), 1.0);
}

// The row y = 1 is at 1 - 1.5 t, a third of which is kept until t = 4/9. Both rows of cells lose 3 and 1 of area (2
// wide); a hundredth of these 4 is squeezed more where 2 (1.5 t - 2/3) = 0.04.
TEST(ShareBeforeFold, ARowThatRunsAhead_StopsAboveTheRowUnderIt) {
  const SheetUnderALid sheet(0.75F);
  EXPECT_NEAR(share_before_fold(sheet.model, sheet.rig, lid_by(-2.0)), (2.0 / 3.0 + 0.02) / 1.5, 1e-5);
}

TEST(ShareBeforeFold, OtherPartsAndBackFaces_DoNotCount) {
  SheetUnderALid sheet(0.75F);
  for (Triangle& t : sheet.model.triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(share_before_fold(sheet.model, sheet.rig, lid_by(-2.0)), 1.0);
  sheet = SheetUnderALid(0.75F);
  sheet.rig.parts[0].role = PartRole::attached;
  EXPECT_EQ(share_before_fold(sheet.model, sheet.rig, lid_by(-2.0)), 1.0);
}

TEST(AreJoined, OpenLipsAndLidsAreNot) {
  const Surface surface = build_surface(testing::sample_head_model());
  const auto points = surface_points(surface, testing::sample_head_points());
  for (const mpeg4::Opening& opening : mpeg4::openings)
    EXPECT_FALSE(are_joined(surface, opening, points)) << opening.name;
}

TEST(AreJoined, ASheetFromRimToRimIs) {
  const SheetUnderALid sheet(0.5F);
  const Surface surface = build_surface(sheet.model);
  const auto point = [&](const char* name, std::uint32_t vertex) {
    const SurfaceVertexId at = surface.surface_of[vertex];
    return SurfacePoint{id_of(name), at, surface.positions[at.value()]};
  };
  const std::vector<SurfacePoint> points = {point("3.1", 7), point("3.3", 4), point("3.7", 5), point("3.11", 6)};
  const auto crossing = shortest_crossing(surface, mpeg4::openings[1], points);
  ASSERT_TRUE(crossing.has_value());
  EXPECT_EQ(crossing->upper.id, id_of("3.1"));
  // One unit; around the corner from (1, 2) to (2, 1) and on to (1, 1): sqrt(2) + 1.
  EXPECT_NEAR(crossing->share, 1.0 / (std::sqrt(2.0) + 1.0), 1e-12);
  EXPECT_EQ(crossing->way.size(), 2U);
  EXPECT_TRUE(are_joined(surface, mpeg4::openings[1], points));

  // A ball before the sheet hides it; one behind it, or beside the way, does not.
  const auto with_ball = [&](const glm::dvec3& center) {
    return are_joined(surface, mpeg4::openings[1], points, Sphere{center, 3.0, 0.0});
  };
  EXPECT_FALSE(with_ball({1.0, 1.5, 0.0}));
  EXPECT_TRUE(with_ball({1.0, 1.5, -4.0}));
  EXPECT_TRUE(with_ball({9.0, 1.5, 0.0}));
}

}  // namespace
}  // namespace semblante

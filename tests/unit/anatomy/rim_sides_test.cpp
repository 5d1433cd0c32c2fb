#include "core/anatomy/rim_sides.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

using testing::fp;

/// The closed mouth with some of its points; the corners are at columns -2 and 2.
class RimSidesOfAMouth : public ::testing::Test {
 protected:
  void mark(std::string_view name, int column, int row, bool of_upper = false) {
    const SurfaceVertexId vertex = surface_.surface_of[mouth_.at(column, row, of_upper)];
    anchors_.push_back({fp(name), vertex, surface_.positions[vertex.value()]});
  }
  void mark_corners() {
    mark("2.4", 2, 0);
    mark("2.5", -2, 0);
  }
  [[nodiscard]] double side(int column, int row, bool of_upper = false) const {
    return RimSides(surface_, mpeg4::mouth, anchors_).side(surface_.surface_of[mouth_.at(column, row, of_upper)]);
  }
  void expect_rims_are_told(double least = RimSides::clear) const {
    for (const int column : {-1, 0, 1}) {
      EXPECT_GE(side(column, 0, true), least) << column;
      EXPECT_LE(side(column, 0, false), -least) << column;
    }
  }

  testing::ClosedMouth mouth_ = testing::make_closed_mouth();
  Surface surface_ = build_surface(mouth_.model);
  std::vector<SurfacePoint> anchors_;
};

TEST_F(RimSidesOfAMouth, AreToldByTheMiddlesThoughTheRimsAreAtOnePlace) {
  mark("2.2", 0, 0, true);
  mark("2.3", 0, 0, false);
  mark_corners();
  expect_rims_are_told();
  EXPECT_GE(side(1, 1), RimSides::clear);
  EXPECT_NEAR(side(2, 0), 0.0, 1e-9);
}

TEST_F(RimSidesOfAMouth, AreToldByPointsOfUnequalDistance) {
  mark("9.15", 0, 4);
  mark("2.3", 0, 0, false);
  mark_corners();
  expect_rims_are_told();
}

TEST_F(RimSidesOfAMouth, AreToldByNoseAndChinAlone) {
  mark("9.3", 0, 4);
  mark("2.1", 0, -3);
  mark_corners();
  expect_rims_are_told(0.4);  // ways along the edges of a grid are up to 1.4 times too long
}

TEST_F(RimSidesOfAMouth, AreNotToldWithPointsOfOneSideAlone) {
  mark("2.2", 0, 0, true);
  mark_corners();
  EXPECT_FALSE(RimSides(surface_, mpeg4::mouth, anchors_).have_anchors());
  EXPECT_EQ(side(1, 0, true), 0.0);
}

TEST_F(RimSidesOfAMouth, AreNotClearWhereTheLipsAreWelded) {
  // One vertex in place of each two of the rims: across is as short as along.
  for (Triangle& t : mouth_.model.triangles) {
    for (std::uint32_t& corner : t) {
      for (const int column : {-1, 0, 1})
        if (corner == mouth_.at(column, 0, true)) corner = mouth_.at(column, 0, false);
    }
  }
  surface_ = build_surface(mouth_.model);
  mark("2.2", 0, 1);
  mark("2.3", 0, -1);
  mark_corners();
  EXPECT_LT(std::abs(side(1, 0)), RimSides::clear);
  EXPECT_LT(std::abs(side(0, 0)), RimSides::clear);
}

TEST(RimSides, OfLidsThatArePartsOfTheirOwnAreToldByTheirPart) {
  Model model = testing::make_strip(4);
  const std::uint32_t lower = testing::append(model, testing::shifted(testing::make_strip(4), {0, -1, 0.5F}), "");
  const std::uint32_t other = testing::append(model, testing::shifted(testing::make_strip(4), {0, 5, 0}), "");
  const Surface surface = build_surface(model);
  const auto at = [&](std::uint32_t vertex) { return surface.surface_of[vertex]; };
  const std::vector<SurfacePoint> anchors = {{fp("3.1"), at(1), glm::dvec3(1, 0, 0)},
                                             {fp("3.3"), at(lower + 1), glm::dvec3(1, -1, 0.5)}};
  const RimSides sides(surface, mpeg4::openings[1], anchors);
  EXPECT_EQ(sides.side(at(3)), 1.0);
  EXPECT_EQ(sides.side(at(lower + 3)), -1.0);
  EXPECT_EQ(sides.side(at(other)), 0.0);
}

TEST(RimOfPoint, IsTheLipOrLidAndNothingForCorners) {
  EXPECT_TRUE(rim_of_point(fp("2.7")).is_upper);
  EXPECT_FALSE(rim_of_point(fp("2.9")).is_upper);
  EXPECT_EQ(rim_of_point(fp("8.8")).opening, &mpeg4::mouth);
  EXPECT_EQ(rim_of_point(fp("3.4")).opening, &mpeg4::openings[2]);
  EXPECT_TRUE(rim_of_point(fp("3.14")).is_upper);
  for (const char* const name : {"2.4", "2.5", "8.3", "8.4", "3.7", "3.8", "3.11", "3.12", "3.5", "2.1", "9.15"})
    EXPECT_EQ(rim_of_point(fp(name)).opening, nullptr) << name;
}

}  // namespace
}  // namespace semblante

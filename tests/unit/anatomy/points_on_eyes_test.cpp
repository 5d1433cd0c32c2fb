// Points of lids that are marked on an eye which is one skin with them.
#include "core/anatomy/points_on_eyes.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/anatomy/modelled_eye.h"
#include "tests/support/sculpted_eye.h"

namespace semblante {
namespace {

using testing::sculpted_edge;
using testing::SculptedEye;

std::vector<PointOnEye> found_on(const SculptedEye& head) {
  return find_points_on_eyes(head.surface, head.model.triangles, head.parts, head.points);
}

struct Misplaced {
  const char* name;
  double x, y;  ///< on the eye
};

void PrintTo(const Misplaced& at, std::ostream* out) { *out << at.name << " at " << at.x << ", " << at.y; }

class PointsOnEyes : public ::testing::TestWithParam<Misplaced> {};

TEST_P(PointsOnEyes, AreNamed_AndTheLidsCloseWhereTheyBelong) {
  SculptedEye head(0.08);
  const auto& [name, x, y] = GetParam();
  head.mark(name, x, y);
  const std::vector<PointOnEye> found = found_on(head);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(to_string(found[0].point.id), name);
  EXPECT_EQ(found[0].lids, &mpeg4::lids_of(0));
  const glm::dvec3& edge = head.surface.positions[found[0].edge.value()];
  EXPECT_NEAR(std::abs(edge.y), sculpted_edge(edge.x), 0.06);
  head.mark(name, edge.x, edge.y);
  EXPECT_TRUE(found_on(head).empty());
  EXPECT_TRUE(find_modelled_eyes(head.surface, head.model.triangles, head.parts, head.points)[0].has_value());
}

INSTANTIATE_TEST_SUITE_P(Lids, PointsOnEyes,
                         ::testing::Values(Misplaced{"3.1", 0.0, 0.15}, Misplaced{"3.1", 0.2, 0.25},
                                           Misplaced{"3.3", 0.0, -0.15}, Misplaced{"3.3", -0.3, -0.2},
                                           Misplaced{"3.7", 0.7, 0.0}, Misplaced{"3.11", -0.7, 0.0}));

TEST(PointsOnEyes, BothLidsAndACornerAreNamed) {
  SculptedEye head(0.08);
  head.mark("3.1", 0.0, 0.25);
  head.mark("3.3", 0.0, -0.25);
  head.mark("3.11", -0.8, 0.0);
  EXPECT_EQ(found_on(head).size(), 3U);
}

TEST(PointsOnEyes, AreNone_OnTheEdges) { EXPECT_TRUE(found_on(SculptedEye(0.08)).empty()); }

TEST(PointsOnEyes, AreNone_OnASheetWithoutAStep) {
  SculptedEye head(0.0);
  head.mark("3.3", 0.0, -0.15);
  EXPECT_TRUE(found_on(head).empty());
}

TEST(PointsOnEyes, AreNone_WithAnEyeballOfItsOwn) {
  SculptedEye head(0.08);
  head.mark("3.3", 0.0, -0.15);
  head.parts.emplace_back().role = PartRole::left_eye;
  EXPECT_TRUE(found_on(head).empty());
}

// A closed lid is a smooth patch between its fold and its edge, as the eye is here.
TEST(PointsOnEyes, AreNone_OfAClosedEye) {
  SculptedEye head(0.08);
  head.mark("3.1", 0.0, -0.3);
  EXPECT_TRUE(found_on(head).empty());
}

}  // namespace
}  // namespace semblante

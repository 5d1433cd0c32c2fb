// Points of one lip or lid that are marked on the other.

#include "core/anatomy/rim_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/sculpted_eye.h"
#include "tests/unit/doctor/heads.h"
#include "tests/unit/doctor/spoil.h"

namespace semblante::testing {
namespace {

using ::testing::HasSubstr;

/// Puts a point at a vertex beside `like`, a point of the other rim: the one nearest to the middle of the face, because
/// at the corners the sides are uncertain.
void misplace(Head& head, std::string_view name, std::string_view like) {
  const Surface surface = build_surface(head.model);
  const SurfaceVertexId there = surface.surface_of[point(head, like).vertex->value()];
  const auto steps = surface.steps_from(there);
  const SurfaceVertexId beside =
      std::min_element(steps.begin(), steps.end(), [&](const auto& a, const auto& b) {
        const auto off = [&](const auto& s) { return std::abs(surface.positions[s.to.value()].x); };
        return off(a) < off(b);
      })->to;
  FeaturePoint& moved = point(head, name);
  moved.vertex = surface.file_vertex_of[beside.value()];
  moved.position = head.model.positions[moved.vertex->value()];
}

const Finding* find_code(const Report& report, FindingCode code) {
  const auto found =
      std::find_if(report.findings.begin(), report.findings.end(), [&](const Finding& f) { return f.code == code; });
  return found == report.findings.end() ? nullptr : &*found;
}

class RimPoints : public ::testing::TestWithParam<const char*> {};

TEST_P(RimPoints, OfAnUnchangedHeadAreOnTheirOwnSide) {
  const auto head = head_named(GetParam());
  if (!head) GTEST_SKIP() << "no folder of real heads";
  EXPECT_EQ(find_code(examine_without_weights(*head), FindingCode::point_on_other_rim), nullptr);
}

TEST_P(RimPoints, OnTheOtherLipAreMovedBackByTheRemedy) {
  for (const auto& [name, like, words] : {std::array<const char*, 3>{"2.8", "2.6", "2.8 lies on the upper lip"},
                                          std::array<const char*, 3>{"2.3", "2.2", "2.3 lies on the upper lip"},
                                          std::array<const char*, 3>{"2.7", "2.9", "2.7 lies on the lower lip"}}) {
    auto head = head_named(GetParam());
    if (!head) GTEST_SKIP() << "no folder of real heads";
    if (find_code(examine_without_weights(*head), FindingCode::lips_joined) != nullptr)
      GTEST_SKIP() << "its lips are joined";
    misplace(*head, name, like);
    const Report before = examine_without_weights(*head);
    const Finding* const finding = find_code(before, FindingCode::point_on_other_rim);
    ASSERT_NE(finding, nullptr) << name;
    EXPECT_THAT(finding->words, HasSubstr(words));
    EXPECT_EQ(find_code(before, FindingCode::lips_joined), nullptr) << "nothing of the mesh is to be deleted";
    ASSERT_TRUE(finding->move);
    EXPECT_EQ(to_string(finding->move->point), name);
    FeaturePoint& moved = point(*head, name);
    moved.vertex = finding->move->vertex;
    moved.position = head->model.positions[moved.vertex->value()];
    EXPECT_EQ(glm::vec3(finding->move->position), moved.position);
    const Report after = examine_without_weights(*head);
    EXPECT_EQ(find_code(after, FindingCode::point_on_other_rim), nullptr) << name;
    EXPECT_EQ(find_code(after, FindingCode::lips_joined), nullptr) << name;
  }
}

TEST_P(RimPoints, OnTheFoldOfALidAreMovedToItsEdgeByTheRemedy) {
  if (std::string_view(GetParam()) == "mediapipe-canonical") GTEST_SKIP() << "skin covers its eyes";
  auto head = head_named(GetParam());
  if (!head) GTEST_SKIP() << "no folder of real heads";
  EXPECT_EQ(find_code(examine_without_weights(*head), FindingCode::point_off_lid_edge), nullptr);
  const double open = point(*head, "3.1").position.y - point(*head, "3.3").position.y;
  if (open < 0.12 * (point(*head, "3.5").position.x - point(*head, "3.6").position.x))
    GTEST_SKIP() << "its eyes are not open";
  misplace(*head, "3.1", "3.13");
  const double on_fold = point(*head, "3.1").position.y;
  const Report before = examine_without_weights(*head);
  const Finding* const finding = find_code(before, FindingCode::point_off_lid_edge);
  ASSERT_NE(finding, nullptr);
  EXPECT_THAT(finding->words, HasSubstr("3.1 lies on the fold of the upper lid"));
  ASSERT_TRUE(finding->move);
  EXPECT_EQ(to_string(finding->move->point), "3.1");
  EXPECT_LT(finding->move->position.y, on_fold);
  FeaturePoint& moved = point(*head, "3.1");
  moved.vertex = finding->move->vertex;
  moved.position = head->model.positions[moved.vertex->value()];
  EXPECT_EQ(find_code(examine_without_weights(*head), FindingCode::point_off_lid_edge), nullptr);
}

Report examine_sculpture(const SculptedEye& sculpture) {
  Head head;
  head.model = sculpture.model;
  for (const SurfacePoint& p : sculpture.points)
    head.points.push_back({p.id, sculpture.surface.file_vertex_of[p.vertex.value()], glm::vec3(p.position)});
  return examine_without_weights(head);
}

/// A ball behind the lids that a converter has merged with them.
TEST(WeldedEyes, AreAWarning) {
  const Report report = examine_sculpture(ball_behind_lids(true));
  const Finding* const finding = find_code(report, FindingCode::eye_welded);
  ASSERT_NE(finding, nullptr);
  EXPECT_EQ(finding->severity, Severity::warning);
  EXPECT_THAT(finding->words, HasSubstr("the left eyeball is welded to the lids"));
  EXPECT_THAT(finding->words, HasSubstr("FAPs 23, 25 and 27"));
  ASSERT_TRUE(finding->place.position.has_value());
  EXPECT_NEAR(glm::length(*finding->place.position), sculpted_radius, 0.1 * sculpted_radius);
  EXPECT_EQ(std::count_if(report.findings.begin(), report.findings.end(),
                          [](const Finding& f) { return f.code == FindingCode::eye_cannot_turn; }),
            1)
      << "the right eye alone";
}

TEST(WeldedEyes, AreNeitherSeparateBallsNorSculptures) {
  for (const SculptedEye& eye : {ball_behind_lids(false), SculptedEye(0.08)}) {
    const Report report = examine_sculpture(eye);
    EXPECT_EQ(find_code(report, FindingCode::eye_welded), nullptr);
    EXPECT_NE(find_code(report, FindingCode::eye_cannot_turn), nullptr);
  }
}

/// A sculpture, whose eye is one skin with its lids.
TEST(PointsOnModelledEyes, AreMovedToTheEdgeOfTheirLidByTheRemedy) {
  SculptedEye sculpture(0.08);
  const auto report = [&] { return examine_sculpture(sculpture); };
  EXPECT_EQ(find_code(report(), FindingCode::point_on_eye), nullptr);
  sculpture.mark("3.3", 0.0, -0.15);
  const Report before = report();
  const Finding* const finding = find_code(before, FindingCode::point_on_eye);
  ASSERT_NE(finding, nullptr);
  EXPECT_EQ(finding->severity, Severity::warning);
  EXPECT_THAT(finding->words, HasSubstr("3.3 lies on the eye instead of the edge of the lower lid"));
  EXPECT_EQ(find_code(before, FindingCode::lids_joined), nullptr) << "nothing of the mesh is to be deleted";
  ASSERT_TRUE(finding->move);
  EXPECT_EQ(to_string(finding->move->point), "3.3");
  sculpture.mark("3.3", finding->move->position.x, finding->move->position.y);
  EXPECT_EQ(sculpture.surface.file_vertex_of[sculpture.point("3.3").vertex.value()], finding->move->vertex);
  EXPECT_EQ(find_code(report(), FindingCode::point_on_eye), nullptr);
}

/// A point that is marked a millimetre or two above the edge of its lid.
TEST(LidEdge, IsMissedByASixthOfTheWay_AndTold) {
  std::size_t measured = 0;
  for (const char* const name : {"sample", "broad", "ict-facekit", "makehuman"}) {
    auto head = head_named(name);
    if (!head) continue;
    const glm::dvec3 edge = place(*head, "3.1");
    const double open = edge.y - place(*head, "3.3").y;
    const std::uint32_t above = skin_vertex_near(*head, edge + glm::dvec3(0.0, 0.2 * open, 0.1 * open));
    const double height = glm::dvec3(head->model.positions[above]).y - edge.y;
    const double share = height / (open + height);
    if (share < 0.155 || share > 0.195) continue;  // no vertex is there
    mark(*head, "3.1", above);
    EXPECT_NE(find_code(examine_without_weights(*head), FindingCode::point_off_lid_edge), nullptr) << name;
    ++measured;
  }
  if (measured == 0) GTEST_SKIP() << "no head has a vertex there";
}

INSTANTIATE_TEST_SUITE_P(Heads, RimPoints,
                         ::testing::Values("sample", "pressed lips", "broad", "closed eyes", "ict-facekit", "makehuman",
                                           "mediapipe-canonical"));

TEST(ClosedEyes, AreAWarningAndUnitsAreEstimated) {
  const Report report = examine_without_weights(*head_named("closed eyes"));
  const Finding* const finding = find_code(report, FindingCode::eye_not_open);
  ASSERT_NE(finding, nullptr);
  EXPECT_EQ(finding->severity, Severity::warning);
  EXPECT_THAT(finding->words, HasSubstr("is closed"));
  EXPECT_EQ(find_code(report, FindingCode::unit_not_positive), nullptr);
}

}  // namespace
}  // namespace semblante::testing

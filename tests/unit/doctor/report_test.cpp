// The report as a whole: bounded on hostile meshes, documented, and its words.
#include "core/doctor/report.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/anatomy/part_roles.h"
#include "core/doctor/examine.h"
#include "core/doctor/marked_points.h"
#include "core/doctor/words.h"
#include "tests/support/meshes.h"
#include "tests/unit/doctor/heads.h"
#include "tests/unit/doctor/spoil.h"

namespace semblante {
namespace {

using ::testing::HasSubstr;

Report examine_alone(const Model& model) {
  const Surface surface = build_surface(model);
  return examine_mesh(model, surface, describe_parts(model, surface, {}));
}

TEST(DoctorReport, HostileMesh_GivesABoundedReport) {
  Model model = testing::make_grid(2, 2);
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    model.positions.emplace_back(0.0F, 0.0F, 0.0F);
    model.positions.emplace_back(1e-30F, 1e30F, static_cast<float>(i));
    const auto last = static_cast<std::uint32_t>(model.positions.size());
    model.triangles.push_back({last - 1, last - 2, 0});     // without area, or as long as a number goes
    model.triangles.push_back({0, 1, 4});                   // many times the same
    model.triangles.push_back({0, 1, last - 1});            // a hundred thousand at one edge
    model.triangles.push_back({last - 2, last - 2, last});  // no triangle, and no vertex
    model.triangles.back()[2] = last - 1;
  }
  model.primitives.back().triangle_count = static_cast<std::uint32_t>(model.triangles.size());
  const Report report = examine_alone(model);
  EXPECT_LE(report.findings.size(), 12U);
  for (const Finding& finding : report.findings) {
    EXPECT_LE(finding.place.vertices.vertices.size(), VertexSample::capacity);
    EXPECT_LE(finding.words.size(), 600U);
  }
  EXPECT_GT(report.counts().notes, 0U);
}

TEST(DoctorReport, ManyFindingsOfAKind_AreNotAllTold) {
  testing::Head head = testing::sample_head();
  const double reach = 1.5 * testing::unit(head);
  std::vector<bool> at_a_hole(head.model.positions.size(), false);
  std::vector<std::uint32_t> holes;
  for (const std::uint32_t t : testing::triangles_near(head, testing::place(head, "9.3"), reach)) {
    const Triangle& corners = head.model.triangles[t];
    if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return at_a_hole[v]; })) continue;
    for (const std::uint32_t v : corners) at_a_hole[v] = true;
    holes.push_back(t);
  }
  testing::erase(head, holes);
  const Report report = testing::examine_without_weights(head);
  std::vector<const Finding*> told;
  for (const Finding& finding : report.findings)
    if (finding.code == FindingCode::hole_near_points) told.push_back(&finding);
  ASSERT_EQ(told.size(), 100U);
  EXPECT_THAT(told.back()->words, HasSubstr("; the same applies to "));
}

// Its free edges surround nothing: `non-manifold-edges` tells it.
TEST(DoctorReport, AFlapThatStandsOnTheSkin_IsNoHole) {
  testing::Head head = testing::sample_head();
  const auto holes_of = [&head] {
    const auto findings = testing::examine_without_weights(head).findings;
    return std::count_if(findings.begin(), findings.end(),
                         [](const Finding& f) { return f.code == FindingCode::hole_near_points; });
  };
  const auto before = holes_of();
  const glm::dvec3 cheek = testing::place(head, "5.3");
  const double unit = testing::unit(head);
  const auto near = testing::triangles_near(head, cheek, 0.2 * unit);
  ASSERT_FALSE(near.empty());
  const Triangle under = head.model.triangles[near.front()];
  testing::begin_primitive(head, "flap");
  const glm::dvec3 tip = glm::dvec3(head.model.positions[under[0]]) + glm::dvec3(0.0, 0.0, 0.05 * unit);
  testing::add_triangle(head, {under[0], under[1], testing::add_vertex(head, tip)});
  EXPECT_EQ(holes_of(), before);
}

std::vector<Finding> idle_parts(const testing::Head& head) {
  std::vector<Finding> idle;
  for (const Finding& finding : testing::examine_without_weights(head).findings) {
    if (finding.code == FindingCode::idle_part) idle.push_back(finding);
  }
  return idle;
}

TEST(DoctorReport, ManyIdleParts_AreOneFinding_AndNoneWhoseNameSaysThatTheyStay) {
  const auto with_plates = [](int count, const std::string& name) {
    testing::Head head = testing::sample_head();
    const double top = testing::place(head, "8.2").y;
    const double bottom = testing::place(head, "2.1").y;
    const double back = testing::place(head, "2.13").z;
    const double unit = testing::unit(head);
    for (int i = 0; i < count; ++i) {
      testing::begin_primitive(head, name + std::to_string(i));
      testing::copy_skin(head, glm::dmat3(1.0), unit * glm::dvec3(0.0, 0.0, 0.03 + 0.002 * i),
                         [=](const glm::dvec3& at) { return at.y < top && at.y > bottom && at.z > back; });
    }
    return head;
  };
  EXPECT_EQ(idle_parts(with_plates(2, "plate ")).size(), 2U);
  const auto many = idle_parts(with_plates(22, "plate "));
  ASSERT_EQ(many.size(), 1U);
  EXPECT_THAT(many[0].words, ::testing::StartsWith("22 parts: part "));
  EXPECT_THAT(many[0].words, HasSubstr("\"plate 3\", ..., "));
  EXPECT_TRUE(idle_parts(with_plates(3, "Sunglasses ")).empty());
}

TEST(DoctorReport, MeshWithoutTriangles_IsExaminedToo) {
  Model model;
  model.positions.assign(3, glm::vec3(0.0F));
  EXPECT_EQ(examine_alone(model).findings.size(), 1U) << "its vertices are unused, and that is all";
  EXPECT_TRUE(examine_alone(Model{}).findings.empty());
}

TEST(DoctorReport, MeshFaults_AreFoundBeforeAnyPointIsMarked) {
  Model model = testing::make_ball({0, 0, 0}, 1.0F);
  EXPECT_TRUE(examine_alone(model).findings.empty());
  std::swap(model.triangles[40][1], model.triangles[40][2]);
  const Report report = examine_alone(model);
  ASSERT_EQ(report.findings.size(), 1U);
  EXPECT_EQ(report.findings[0].code, FindingCode::inconsistent_winding);
}

TEST(DoctorReport, RefusedPoints_AreFindings_AndTheRestIsPlaced) {
  const Model model = testing::make_grid(4, 4);
  const Surface surface = build_surface(model);
  const PlacedPoints placed = place_what_can_be(
      model, surface,
      {testing::at_vertex("2.1", 999), testing::at_vertex("2.2", 3), testing::at_position("2.3", {0.0, 0.0, 1e6})});
  ASSERT_EQ(placed.points.size(), 1U);
  EXPECT_EQ(placed.points[0].id, testing::fp("2.2"));
  ASSERT_EQ(placed.refused.size(), 2U);
  EXPECT_EQ(placed.refused[0].place.points, std::vector{testing::fp("2.1")});
  EXPECT_THAT(placed.refused[0].words, HasSubstr("999"));
  EXPECT_EQ(placed.refused[1].place.points, std::vector{testing::fp("2.3")});
}

TEST(DoctorReport, ErrorsComeFirst) {
  testing::Head head = testing::sample_head();
  testing::add_vertex(head, {0, 0, 1});
  testing::exchange(head, "8.3", "8.4");
  const Report report = testing::examine_without_weights(head);
  ASSERT_GE(report.findings.size(), 2U);
  EXPECT_EQ(report.findings.front().severity, Severity::error);
  EXPECT_EQ(report.findings.back().severity, Severity::note);
  EXPECT_EQ(report.counts(), (FindingCounts{1, 0, 1}));
}

TEST(DoctorReport, LipsThatTouch_AreNoOpenSeam) {
  testing::Head head = testing::sample_head();
  const glm::dvec3 lip = testing::place(head, "2.2");
  const double radius = 0.08 * testing::unit(head);
  testing::cut(head, [=](const glm::dvec3& at) { return glm::distance(at, lip) < radius; },
               {0.0, 0.0, 1e-4 * testing::unit(head)});
  const auto has_seam = [](const Report& report) {
    return std::any_of(report.findings.begin(), report.findings.end(),
                       [](const Finding& finding) { return finding.code == FindingCode::open_seam; });
  };
  EXPECT_TRUE(has_seam(examine_alone(head.model))) << "without points a slit cannot be told from a seam";
  EXPECT_FALSE(has_seam(testing::examine_without_weights(head)));
}

TEST(DoctorReport, QuickSetOfPoints_IsToldInAFewGroupedFindings) {
  testing::Head head = testing::sample_head();
  std::erase_if(head.points, [](const FeaturePoint& p) {
    const int group = group_of(p.id);
    return group != 2 && group != 8 && group != 3 && to_string(p.id) != "9.15";
  });
  const Report report = testing::examine_without_weights(head);
  EXPECT_EQ(report.counts().errors, 0U) << "every unit can be measured";
  EXPECT_LE(report.findings.size(), 8U);
  for (const Finding& finding : report.findings) EXPECT_EQ(finding.code, FindingCode::missing_points) << finding.words;
  const auto brows = std::find_if(report.findings.begin(), report.findings.end(), [](const Finding& finding) {
    return finding.words.starts_with(
        "brows: 4.1, 4.2, 4.3, 4.4, 4.5 and 4.6 are not marked; FAPs 31-38 have no effect");
  });
  EXPECT_NE(brows, report.findings.end());
}

TEST(DoctorReport, EveryCode_IsInTheReadme) {
  std::ifstream in(std::string(SEMBLANTE_SOURCE_DIR) + "/core/doctor/README.md");
  const std::string readme{std::istreambuf_iterator<char>(in), {}};
  for (const std::string_view code : finding_code_names) {
    std::string quoted("`");
    quoted.append(code).append("`");
    EXPECT_THAT(readme, HasSubstr(quoted));
  }
}

TEST(DoctorWords, ListsAndCounts) {
  EXPECT_EQ(count_of(1, "edge joins", "edges join"), "1 edge joins");
  EXPECT_EQ(count_of(0, "edge joins", "edges join"), "0 edges join");
  const std::vector points = {testing::fp("2.2"), testing::fp("2.3"), testing::fp("8.1")};
  EXPECT_EQ(list_of(points), "2.2, 2.3 and 8.1");
  EXPECT_EQ(list_of(std::span(points).first(1)), "2.2");
  EXPECT_EQ(percent(0.1149), "11 %");
}

}  // namespace
}  // namespace semblante

// Every defect that the doctor claims to find is planted into good heads: it must be found, with its code, at its
// place.
#include <algorithm>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/unit/doctor/defects.h"
#include "tests/unit/doctor/spoil.h"

namespace semblante {
namespace {

using testing::Defect;
using testing::Expected;
using testing::Head;

bool is_there(const Head& head, const Finding& finding, const Expected& expected, double reach) {
  const auto& place = finding.place;
  for (const FeaturePointId id : expected.points)
    if (std::find(place.points.begin(), place.points.end(), id) == place.points.end()) return false;
  if (finding.words.find(expected.says) == std::string::npos) return false;
  if (expected.part && place.part != expected.part) return false;
  if (!expected.near) return true;
  const auto close = [&](const glm::dvec3& at) { return glm::distance(at, *expected.near) < reach; };
  return (place.position && close(*place.position)) ||
         std::any_of(place.vertices.vertices.begin(), place.vertices.vertices.end(),
                     [&](VertexId v) { return close(head.model.positions[v.value()]); });
}

std::string told(const Report& report) {
  std::string text;
  for (const Finding& finding : report.findings)
    text += std::string(to_string(finding.code)) + ": " + finding.words + "\n";
  return text;
}

class PlantedDefects : public ::testing::TestWithParam<const char*> {};

TEST_P(PlantedDefects, AreFound_AtTheirPlaces) {
  const std::optional<Head> good = testing::head_named(GetParam());
  if (!good) GTEST_SKIP() << "there is no folder of real heads";
  for (const Defect& defect : testing::defects()) {
    SCOPED_TRACE(defect.name);
    Head head = *good;
    const double reach = 0.25 * testing::unit(head);
    const std::optional<Expected> expected = defect.plant(head);
    if (!expected) continue;
    const Report report = defect.needs_weights ? testing::examine_with_weights(head, WeightMethod::smooth)
                                               : testing::examine_without_weights(head);
    EXPECT_TRUE(std::any_of(report.findings.begin(), report.findings.end(),
                            [&](const Finding& finding) {
                              return finding.code == defect.code && is_there(head, finding, *expected, reach);
                            }))
        << "no " << to_string(defect.code) << " there, but:\n"
        << told(report);
    for (const Finding& finding : report.findings) {
      EXPECT_FALSE(finding.words.empty());
      EXPECT_FALSE(finding.remedy.empty());
      EXPECT_LE(finding.place.vertices.vertices.size(), VertexSample::capacity);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Doctor, PlantedDefects,
                         ::testing::Values("sample", "broad", "long", "pressed lips", "body", "ict-facekit",
                                           "makehuman"),
                         [](const auto& info) {
                           std::string name = info.param;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return c == '-' || c == ' '; }, '_');
                           return name;
                         });

}  // namespace
}  // namespace semblante

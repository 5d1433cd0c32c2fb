// No false alarm: on heads that nobody spoiled the findings are those that their README describes, and no other.
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/unit/doctor/heads.h"
#include "tests/unit/doctor/spoil.h"

namespace semblante {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// "warning lips-joined 2.2 2.3", two points at most, in the order of the report.
std::vector<std::string> lines(const Report& report) {
  std::vector<std::string> list;
  for (const Finding& finding : report.findings) {
    std::string line(severity_names[static_cast<std::size_t>(finding.severity)]);
    line.append(" ").append(to_string(finding.code));
    for (std::size_t i = 0; i < std::min<std::size_t>(finding.place.points.size(), 2); ++i)
      line.append(" ").append(to_string(finding.place.points[i]));
    list.push_back(std::move(line));
  }
  return list;
}

TEST(GoodHeads, Sample_HasNoFinding) {
  EXPECT_THAT(lines(testing::examine_with_weights(testing::sample_head(), WeightMethod::smooth)), IsEmpty());
}

// The lids of this head are parts of their own. Its quick set marks one point of each.
TEST(GoodHeads, SampleWithOnePointOnEachLid_HasNoPointOnAWrongPart) {
  testing::Head head = testing::sample_head();
  std::erase_if(head.points, [](const FeaturePoint& p) {
    const std::string name = to_string(p.id);
    return name == "3.13" || name == "3.14";
  });
  for (const Finding& finding : testing::examine_without_weights(head).findings)
    EXPECT_NE(finding.code, FindingCode::point_on_wrong_part) << finding.words;
}

TEST(GoodHeads, OtherPersonsOfOurOwn_HaveNoFinding) {
  for (const char* const name : {"broad", "long", "pressed lips", "body"})
    EXPECT_THAT(lines(testing::examine_with_weights(*testing::head_named(name), WeightMethod::smooth)), IsEmpty())
        << name;
}

TEST(GoodHeads, TurnedToASide_AreToldSoOnce) {
  for (const double degrees : {-15.0, 15.0}) {
    testing::Head head = testing::sample_head();
    testing::transform(head, testing::turn(1, degrees));
    EXPECT_THAT(lines(testing::examine_with_weights(head, WeightMethod::smooth)),
                ElementsAre("warning not-upright 2.1 2.2"))
        << degrees;
  }
}

TEST(GoodHeads, Scan_HasWhatAScanCannotShow) {
  auto found = lines(testing::examine_with_weights(*testing::head_named("scan"), WeightMethod::smooth));
  std::erase_if(found, [](const std::string& line) { return line.find("-leak ") != std::string::npos; });
  EXPECT_THAT(found,
              ElementsAre("warning lips-joined 2.2 2.3", "warning lids-joined 3.1 3.3", "warning lids-joined 3.2 3.4",
                          "warning eye-not-open 3.1 3.3", "warning eye-not-open 3.2 3.4", "note eye-cannot-turn 3.5",
                          "note eye-cannot-turn 3.6", "note missing-points 6.1 6.2", "note missing-points 9.8 9.9"));
}

TEST(GoodHeads, Scan_IsToldHowFarItsEyesClose) {
  const Report report = testing::examine_with_weights(*testing::head_named("scan"), WeightMethod::smooth);
  std::size_t told = 0;
  for (const Finding& finding : report.findings) {
    if (finding.code != FindingCode::lids_joined) continue;
    EXPECT_THAT(finding.words, ::testing::ContainsRegex("a blink closes the eye by [0-9]+ %, until the skin would"));
    ++told;
  }
  EXPECT_EQ(told, 2U);
}

TEST(GoodHeads, Sample_LeaksWithTheWeightsOfThePaperAlone) {
  // A vertex of one lip is partly led by the points of the other: Eq. 3 knows no slit (core/expressions/README.md).
  EXPECT_THAT(lines(testing::examine_with_weights(testing::sample_head(), WeightMethod::paper)),
              ElementsAre("note lips-leak 2.3 2.2", "note lips-leak 2.2 2.3"));
}

class WholeHead : public ::testing::TestWithParam<const char*> {};

TEST_P(WholeHead, MissesTheThicknessOfItsHairAlone) {
  const auto head = testing::real_head(GetParam());
  if (!head) GTEST_SKIP() << "there is no folder of real heads";
  // "11.5 (hair thickness) is not placed: no head has hair."
  std::vector<std::string> expected = {"note missing-points 11.5"};
  // The other person on ICT's mesh has no 7.1 either: that point is no vertex, and nobody placed it anew.
  if (std::string_view(GetParam()).ends_with("identity")) expected.insert(expected.begin(), "note missing-points 7.1");
  EXPECT_EQ(lines(testing::examine_with_weights(*head, WeightMethod::smooth)), expected);

  expected.insert(expected.begin(), {"note lips-leak 2.3 2.2", "note lips-leak 2.2 2.3", "note lids-leak 3.3 3.1",
                                     "note lids-leak 3.1 3.3", "note lids-leak 3.4 3.2", "note lids-leak 3.2 3.4"});
  EXPECT_EQ(lines(testing::examine_with_weights(*head, WeightMethod::paper)), expected);
}

INSTANTIATE_TEST_SUITE_P(Doctor, WholeHead,
                         ::testing::Values("ict-facekit", "ict-facekit identity", "makehuman", "makehuman glb"),
                         [](const auto& info) {
                           std::string name = info.param;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return c == '-' || c == ' '; }, '_');
                           return name;
                         });

TEST(GoodHeads, MediapipeMask_HasWhatItsReadmeSays) {
  const auto head = testing::real_head("mediapipe-canonical");
  if (!head) GTEST_SKIP() << "there is no folder of real heads";
  std::vector<std::string> known = {
      // "Eyes and mouth are closed by triangles."
      "warning lips-joined 2.2 2.3", "warning lids-joined 3.1 3.3", "warning lids-joined 3.2 3.4",
      // "The mouth stands 0.55 open"
      "warning mouth-open 2.2 2.3",
      // "IRISD0 from 3.1 and 3.3 is 0.67, small, since the lids are half closed."
      "warning eye-not-open 3.1 3.3", "warning eye-not-open 3.2 3.4",
      // "there is hardly an ordinary vertex left between two FPs of a lip"
      "warning mouth-too-coarse 2.4 2.6",
      // "no ears, skull, neck, teeth or tongue"
      "note missing-points 6.1 6.2", "note missing-points 9.8 9.9", "note missing-points 10.1 10.2",
      "note missing-points 11.4 11.5"};
  // How much of the leak smooth weights hold back is for their own tests to say.
  auto smooth = lines(testing::examine_with_weights(*head, WeightMethod::smooth));
  std::erase_if(smooth, [](const std::string& line) { return line.find("-leak ") != std::string::npos; });
  EXPECT_EQ(smooth, known);

  // "Upper and lower lip are neighbours across it, so influence crosses the mouth."
  known.insert(known.begin() + 7, {"note lips-leak 2.3 2.2", "note lips-leak 2.2 2.3"});
  EXPECT_EQ(lines(testing::examine_with_weights(*head, WeightMethod::paper)), known);
}

}  // namespace
}  // namespace semblante

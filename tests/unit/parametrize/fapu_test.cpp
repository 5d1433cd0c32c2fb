#include "core/parametrize/fapu.h"

#include <algorithm>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

FeaturePoint bare(std::string_view name, const glm::vec3& position) {
  return {testing::fp(name), std::nullopt, position};
}

const FeaturePointSet whole_face = {
    bare("2.2", {0, -2, 9}),      bare("3.1", {3, 1.5F, 8}),  bare("3.2", {-3, 1.75F, 8}), bare("3.3", {3, 0.5F, 8}),
    bare("3.4", {-3, 0.25F, 8}),  bare("3.5", {3.25F, 1, 8}), bare("3.6", {-3, 1.5F, 8}),  bare("8.3", {2.5F, -2, 8}),
    bare("8.4", {-2.25F, -2, 8}), bare("9.15", {0, -0.5F, 9})};

TEST(Fapu, WholeFace_GivesDifferencesOfOneCoordinateOver1024) {
  const Fapu fapu = compute_fapu(whole_face);
  // IRISD: left 1.5 - 0.5 = 1, right 1.75 - 0.25 = 1.5, mean 1.25.
  EXPECT_DOUBLE_EQ(fapu[FapuUnit::irisd].value() * 1024, 1.25);
  EXPECT_DOUBLE_EQ(fapu[FapuUnit::es].value() * 1024, 6.25);  // 3.25 + 3, though the eyes differ in y
  EXPECT_DOUBLE_EQ(fapu[FapuUnit::ens].value() * 1024, 1.5);  // 1 + 0.5: of the left eye
  EXPECT_DOUBLE_EQ(fapu[FapuUnit::mns].value() * 1024, 1.5);  // -0.5 + 2
  EXPECT_DOUBLE_EQ(fapu[FapuUnit::mw].value() * 1024, 4.75);  // 2.5 + 2.25
  EXPECT_TRUE(explain_missing_fapu(fapu, whole_face).empty());
}

TEST(Fapu, OneEyeAlone_GivesIrisd) {
  const FeaturePointSet points = {bare("3.2", {-3, 1.75F, 8}), bare("3.4", {-3, 0.25F, 8})};
  EXPECT_DOUBLE_EQ(compute_fapu(points)[FapuUnit::irisd].value() * 1024, 1.5);
}

TEST(Fapu, GivenByHand_ReplacesTheMeasuredValue) {
  const auto by_user = fapu_from_lengths({{"ES", 8.0}});
  ASSERT_TRUE(by_user);
  const Fapu fapu = compute_fapu(whole_face, *by_user);
  EXPECT_DOUBLE_EQ(fapu[FapuUnit::es].value() * 1024, 8.0);
  EXPECT_DOUBLE_EQ(fapu[FapuUnit::mw].value() * 1024, 4.75);
  EXPECT_EQ(fapu.origin[static_cast<std::size_t>(FapuUnit::es)], FapuOrigin::user);
  EXPECT_EQ(fapu.origin[static_cast<std::size_t>(FapuUnit::mw)], FapuOrigin::points);
}

TEST(Fapu, HostileLengths_AreRefused) {
  for (const double length :
       {0.0, -1.0, 1e300, 1e-300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    const auto fapu = fapu_from_lengths({{"ES", length}});
    ASSERT_FALSE(fapu) << length;
    EXPECT_EQ(fapu.error().code, ErrorCode::out_of_range);
    EXPECT_THAT(fapu.error().message, HasSubstr("ES"));
  }
  const auto unknown = fapu_from_lengths({{"AU", 1.0}});
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::invalid_argument);
}

TEST(Fapu, ClosedEyes_AreMeasuredBetweenTheCornersOfTheLids) {
  FeaturePointSet points = whole_face;
  std::erase_if(points, [](const FeaturePoint& p) { return p.id == testing::fp("3.6"); });
  for (FeaturePoint& p : points) {
    if (p.id == testing::fp("3.1") || p.id == testing::fp("3.3")) p.position.y = 1.0F;
    if (p.id == testing::fp("3.2") || p.id == testing::fp("3.4")) p.position.y = 1.1F;
  }
  const auto corners = {bare("3.7", {4, 1, 7}), bare("3.11", {2, 1.5F, 8}), bare("3.8", {-2, 1, 8}),
                        bare("3.12", {-4, 1, 7})};
  points.insert(points.end(), corners.begin(), corners.end());
  std::sort(points.begin(), points.end(), [](const FeaturePoint& a, const FeaturePoint& b) { return a.id < b.id; });
  const Fapu fapu = compute_fapu(points);
  EXPECT_DOUBLE_EQ(fapu[FapuUnit::es].value() * 1024, 6.0);
  EXPECT_DOUBLE_EQ(fapu[FapuUnit::irisd].value() * 1024, iris_share * 6.0);
  EXPECT_DOUBLE_EQ(fapu[FapuUnit::ens].value() * 1024, 1.75);
  EXPECT_EQ(fapu.origin[static_cast<std::size_t>(FapuUnit::irisd)], FapuOrigin::closed_eyes);
  EXPECT_TRUE(explain_missing_fapu(fapu, points).empty());
}

TEST(Fapu, OneClosedEye_DoesNotCount) {
  FeaturePointSet points = whole_face;
  for (FeaturePoint& p : points) {
    if (p.id == testing::fp("3.1")) p.position.y = 3.0F;
    if (p.id == testing::fp("3.3")) p.position.y = 1.0F;
    if (p.id == testing::fp("3.2") || p.id == testing::fp("3.4")) p.position.y = 1.0F;
  }
  const Fapu fapu = compute_fapu(points);
  EXPECT_DOUBLE_EQ(fapu[FapuUnit::irisd].value() * 1024, 2.0);
  EXPECT_EQ(fapu.origin[static_cast<std::size_t>(FapuUnit::irisd)], FapuOrigin::points);
}

// An eye 2 high between parallel lids that rise by 1 in 2 to its outer corner: the middle of the lower lid is 0.8
// beside that of the upper one and 1.6 below it, so straight down it is 1.6 + 0.8 / 2 = 2 to the lower lid.
TEST(Fapu, SlantedEye_GivesTheHeightAtOneX) {
  FeaturePointSet points = {bare("3.1", {3, 1.6F, 8}), bare("3.3", {3.8F, 0, 8})};
  EXPECT_FLOAT_EQ(static_cast<float>(compute_fapu(points)[FapuUnit::irisd].value() * 1024), 1.6F);
  points.push_back(bare("3.7", {6, 2, 8}));
  points.push_back(bare("3.11", {2, 0, 8}));
  EXPECT_FLOAT_EQ(static_cast<float>(compute_fapu(points)[FapuUnit::irisd].value() * 1024), 2.0F);
  // Hardly slanted: 1.6 + 0.8 / 16 is less than 1.05 times 1.6, and the unit is the standard's.
  points[2].position.y = 0.25F;
  EXPECT_FLOAT_EQ(static_cast<float>(compute_fapu(points)[FapuUnit::irisd].value() * 1024), 1.6F);
}

TEST(Fapu, MissingPoints_LeaveTheUnitEmptyAndAreNamed) {
  FeaturePointSet points = whole_face;
  std::erase_if(points, [](const FeaturePoint& p) { return p.id == testing::fp("9.15"); });
  const Fapu fapu = compute_fapu(points);
  EXPECT_FALSE(fapu[FapuUnit::ens]);
  EXPECT_FALSE(fapu[FapuUnit::mns]);
  EXPECT_TRUE(fapu[FapuUnit::mw]);
  EXPECT_THAT(explain_missing_fapu(fapu, points),
              ElementsAre(AllOf(HasSubstr("ENS"), HasSubstr("9.15 is not marked")),
                          AllOf(HasSubstr("MNS"), HasSubstr("9.15 is not marked"))));
}

TEST(Fapu, WithoutAnOuterCornerOfTheLips_MwIsMeasuredBetweenTheInnerOnes) {
  FeaturePointSet points = whole_face;
  std::erase_if(points, [](const FeaturePoint& p) { return p.id == testing::fp("8.4"); });
  EXPECT_FALSE(compute_fapu(points)[FapuUnit::mw]);
  const auto corners = {bare("2.4", {2, -2, 8}), bare("2.5", {-1.5F, -2, 8})};
  points.insert(points.end(), corners.begin(), corners.end());
  std::sort(points.begin(), points.end(), [](const FeaturePoint& a, const FeaturePoint& b) { return a.id < b.id; });
  const Fapu fapu = compute_fapu(points);
  EXPECT_DOUBLE_EQ(fapu[FapuUnit::mw].value() * 1024, outer_per_inner_width * 3.5);
  EXPECT_TRUE(explain_missing_fapu(fapu, points).empty());
}

TEST(Fapu, SwappedPoints_LeaveTheUnitEmptyAndSaySo) {
  const FeaturePointSet points = {bare("8.3", {-2, 0, 0}), bare("8.4", {2, 0, 0})};
  const Fapu fapu = compute_fapu(points);
  EXPECT_FALSE(fapu[FapuUnit::mw]);
  EXPECT_THAT(explain_missing_fapu(fapu, points).back(), HasSubstr("8.3 is not to the left of 8.4"));
}

TEST(Fapu, GivenByHand_IsNotSpokenOf) {
  Fapu fapu;
  for (auto& value : fapu.value) value = 0.01;
  EXPECT_TRUE(explain_missing_fapu(fapu, {}).empty());
}

}  // namespace
}  // namespace semblante

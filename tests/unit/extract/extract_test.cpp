#include "core/extract/extract.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/extract/named_set.h"
#include "core/parametrize/fapu.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

using ::testing::HasSubstr;

/// A head of nothing but points: vertex i is the i-th of these. ES0 60, ENS0 40, MNS0 20, MW0 50, IRISD0 10.
struct PointHead : ::testing::Test {
  std::vector<glm::vec3> neutral = {{0, 10, 18},   {0, 40, 20},  {30, 105, 0}, {30, 95, 0},   {30, 100, 5},
                                    {-30, 100, 5}, {15, 115, 4}, {25, 35, 12}, {-25, 35, 12}, {0, 60, 24}};
  std::vector<std::string_view> names = {"2.1", "2.2", "3.1", "3.3", "3.5", "3.6", "4.1", "8.3", "8.4", "9.15"};
  std::vector<glm::vec3> expression = neutral;
  FeaturePointSet points = marked();
  Fapu fapu;

  FeaturePointSet marked() const {
    FeaturePointSet set;
    for (std::size_t i = 0; i < names.size(); ++i)
      set.push_back({testing::fp(names[i]), VertexId(static_cast<std::uint32_t>(i)), neutral[i]});
    return set;
  }
  PointHead() {
    fapu.value[static_cast<std::size_t>(FapuUnit::irisd)] = 10.0 / 1024.0;
    fapu.value[static_cast<std::size_t>(FapuUnit::es)] = 60.0 / 1024.0;
    fapu.value[static_cast<std::size_t>(FapuUnit::ens)] = 40.0 / 1024.0;
    fapu.value[static_cast<std::size_t>(FapuUnit::mns)] = 20.0 / 1024.0;
    fapu.value[static_cast<std::size_t>(FapuUnit::mw)] = 50.0 / 1024.0;
  }
  Result<Extraction> extract(const ExtractOptions& options = {}) const {
    return extract_displacements(points, fapu, neutral, expression, options);
  }
};

TEST_F(PointHead, DividesEachComponentByTheUnitOfItsPointAndAxis) {
  expression[7] += glm::vec3(5, -2, 1);   // 8.3: x 5 / (50 / 1024), y -2 / (20 / 1024), z 1 / (20 / 1024)
  expression[2] += glm::vec3(0, -10, 0);  // 3.1: y -10 / (10 / 1024)
  expression[6] += glm::vec3(-3, 4, 2);   // 4.1: x -3 / (60 / 1024), y 4 / (40 / 1024), z 2 / (40 / 1024)
  const auto result = extract();
  ASSERT_TRUE(result);
  ASSERT_EQ(result->displacements.size(), 3U);
  EXPECT_EQ(to_string(result->displacements[0].point), "3.1");
  EXPECT_EQ(result->displacements[0].value, glm::vec3(0, -1024, 0));
  EXPECT_EQ(to_string(result->displacements[1].point), "4.1");
  EXPECT_EQ(result->displacements[1].value, glm::vec3(-51.2F, 102.4F, 51.2F));
  EXPECT_EQ(to_string(result->displacements[2].point), "8.3");
  EXPECT_EQ(result->displacements[2].value, glm::vec3(102.4F, -102.4F, 51.2F));
  EXPECT_EQ(result->at_rest.size(), 7U);
  EXPECT_EQ(result->unmarked.size(), feature_point_count - 10);
  EXPECT_FALSE(result->removed);
}

TEST_F(PointHead, APartialExampleIsDividedByItsStrength) {
  expression[0] += glm::vec3(0, -5, 0);
  const auto half = extract({.strength = 0.5});
  ASSERT_TRUE(half);
  EXPECT_EQ(half->displacements[0].value, glm::vec3(0, -512, 0));  // -5 / 0.5 / (20 / 1024)
}

TEST_F(PointHead, MovementsBelowTheLeastAreAtRest_OthersKeepAllTheirComponents) {
  expression[0] += glm::vec3(0, -0.9 * 20 / 1024, 0);                   // 0.9 MNS
  expression[1] += glm::vec3(0.5 * 50 / 1024, 1.5 * 20.0 / 1024.0, 0);  // 0.5 MW, 1.5 MNS
  const auto result = extract();
  ASSERT_TRUE(result);
  ASSERT_EQ(result->displacements.size(), 1U);
  EXPECT_EQ(to_string(result->displacements[0].point), "2.2");
  EXPECT_NEAR(result->displacements[0].value.x, 0.5, 1e-3);
  EXPECT_NEAR(result->displacements[0].value.y, 1.5, 1e-3);
  const auto all = extract({.least = 0.0});
  ASSERT_TRUE(all);
  EXPECT_EQ(all->displacements.size(), 2U);
  EXPECT_FALSE(extract({.least = 2.0}));
}

TEST_F(PointHead, APointWhoseUnitIsMissingIsLeftOutByName_OnlyIfItMovesAlongThatAxis) {
  fapu.value[static_cast<std::size_t>(FapuUnit::mw)].reset();
  expression[7] += glm::vec3(5, -2, 0);
  expression[8] += glm::vec3(0, -2, 0);
  const auto result = extract();
  ASSERT_TRUE(result);
  ASSERT_EQ(result->skipped.size(), 1U);
  EXPECT_EQ(to_string(result->skipped[0].point), "8.3");
  EXPECT_EQ(result->skipped[0].unit, FapuUnit::mw);
  ASSERT_EQ(result->displacements.size(), 1U);
  EXPECT_EQ(to_string(result->displacements[0].point), "8.4");
  EXPECT_EQ(explain(*result)[0], "omitted, because MW of this head is unknown: 8.3");
}

TEST_F(PointHead, BarePositionsAreLeftOutByName) {
  points[4].vertex.reset();
  expression[4] += glm::vec3(5, 0, 0);
  expression[0] += glm::vec3(0, -5, 0);
  const auto result = extract();
  ASSERT_TRUE(result);
  ASSERT_EQ(result->bare.size(), 1U);
  EXPECT_EQ(to_string(result->bare[0]), "3.5");
  EXPECT_EQ(result->displacements.size(), 1U);
  EXPECT_EQ(explain(*result)[0], "omitted, because they have no vertex: 3.5");
}

TEST_F(PointHead, RefusesWhatCannotBeAnExampleOfThisHead) {
  const auto nothing = extract();
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, ErrorCode::empty);

  expression[3].y = std::numeric_limits<float>::quiet_NaN();
  const auto not_finite = extract();
  ASSERT_FALSE(not_finite);
  EXPECT_EQ(not_finite.error().code, ErrorCode::not_finite);
  EXPECT_EQ(not_finite.error().where, "vertex 3");

  expression = neutral;
  neutral[5].z = std::numeric_limits<float>::infinity();
  const auto not_finite_at_rest = extract({.align = true});
  ASSERT_FALSE(not_finite_at_rest);
  EXPECT_EQ(not_finite_at_rest.error().where, "vertex 5");
  neutral[5].z = expression[5].z;

  expression = neutral;
  for (auto& p : expression) p *= 1000.0F;
  const auto other_unit = extract();
  ASSERT_FALSE(other_unit);
  EXPECT_EQ(other_unit.error().code, ErrorCode::out_of_range);
  EXPECT_THAT(other_unit.error().message, HasSubstr("the same unit"));

  expression.pop_back();
  const auto other_mesh = extract();
  ASSERT_FALSE(other_mesh);
  EXPECT_EQ(other_mesh.error().code, ErrorCode::mismatch);
  EXPECT_THAT(other_mesh.error().message, HasSubstr("9 vertices, the neutral head 10"));

  expression = neutral;
  for (const double wrong : {0.0, -1.0, 1e3, std::numeric_limits<double>::quiet_NaN()}) {
    const auto refused = extract({.strength = wrong});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().where, "/strength");
  }
  const auto refused = extract({.least = -1.0});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().where, "/least");
}

// The head moves and turns with the expression; half of its vertices say by how much.
TEST_F(PointHead, AligningTakesTheMotionOfTheHeadOut) {
  for (int i = 0; i < 40; ++i) {
    const auto t = static_cast<float>(i);
    neutral.emplace_back(40.0F * std::cos(t), 3.0F * t, -60.0F + 10.0F * std::sin(3.0F * t));
  }
  expression = neutral;
  expression[0] += glm::vec3(0, -5, 0);
  expression[7] += glm::vec3(2.5, 0, 0);
  const double angle = 0.2;
  for (auto& p : expression) {  // 0.2 rad about y, then a shift
    const glm::dvec3 q(p);
    p = glm::vec3(
        glm::dvec3(std::cos(angle) * q.x + std::sin(angle) * q.z, q.y, -std::sin(angle) * q.x + std::cos(angle) * q.z) +
        glm::dvec3(3, -1, 2));
  }
  const auto as_they_lie = extract();
  ASSERT_TRUE(as_they_lie);
  EXPECT_EQ(as_they_lie->displacements.size(), 10U);
  const auto aligned = extract({.align = true});
  ASSERT_TRUE(aligned);
  ASSERT_EQ(aligned->displacements.size(), 2U);
  EXPECT_NEAR(aligned->displacements[0].value.y, -256.0, 0.01);  // -5 / (20 / 1024)
  EXPECT_NEAR(aligned->displacements[1].value.x, 51.2, 0.01);    // 2.5 / (50 / 1024)
  ASSERT_TRUE(aligned->removed);
  EXPECT_NEAR(aligned->removed->degrees, angle * 180.0 / 3.14159265358979, 1e-4);
  EXPECT_GT(aligned->removed->distance, 1.0);
}

TEST_F(PointHead, AligningNeedsVerticesToGoBy) {
  neutral.resize(7);
  expression = neutral;
  expression[0].y -= 5.0F;
  points.resize(7);
  const auto refused = extract({.align = true});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().where, "/align");
}

}  // namespace
}  // namespace semblante

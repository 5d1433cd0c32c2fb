#include "core/propose/found_points.h"

#include <algorithm>
#include <string>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/anatomy/part_roles.h"
#include "core/propose/propose.h"
#include "tests/support/meshes.h"
#include "tests/support/sample_head_model.h"

namespace semblante {
namespace {

using testing::FamilyMember;
using testing::fp;
using testing::sample_head_model;
using testing::sample_head_points;

constexpr std::array eye_names = {"3.1", "3.2", "3.3", "3.4", "3.7", "3.8", "3.11", "3.12"};
constexpr std::array mouth_names = {"2.2", "2.3", "2.4", "2.5"};

/// The reference heads without our own, whose proportions these tests measure.
std::vector<ReferenceHead> heads_of_others() {
  std::vector<ReferenceHead> others(reference_heads().begin(), reference_heads().end());
  std::erase_if(others, [](const ReferenceHead& head) { return head.name == "sample-head"; });
  return others;
}

Result<std::vector<FoundPoint>> find_on(const Model& model) {
  const Surface surface = build_surface(model);
  return find_points_by_shape(surface, describe_parts(model, surface, {}), model.triangles);
}

bool has(const std::vector<FoundPoint>& found, const char* name) {
  return std::any_of(found.begin(), found.end(), [&](const FoundPoint& p) { return p.point.id == fp(name); });
}

double eye_distance(const FeaturePointSet& points) {
  return glm::distance(find_point(points, fp("3.5"))->position, find_point(points, fp("3.6"))->position);
}

class FoundPoints : public ::testing::TestWithParam<FamilyMember> {};

TEST_P(FoundPoints, LieWhereTheyWerePlaced) {
  const SampleHeadTraits& traits = GetParam().traits;
  if (traits.form == SampleHeadForm::scan) return;
  const FeaturePointSet placed = sample_head_points(traits);
  const auto found = find_on(sample_head_model(traits));
  ASSERT_TRUE(found) << found.error().message;
  for (const char* name : eye_names) EXPECT_EQ(has(*found, name), !traits.closed_eyes) << name;
  for (const char* name : mouth_names) EXPECT_TRUE(has(*found, name)) << name;
  for (const char* name : {"3.5", "3.6", "9.3"}) EXPECT_TRUE(has(*found, name)) << name;
  for (const FoundPoint& f : *found) {
    const double off = glm::distance(f.point.position, find_point(placed, f.point.id)->position);
    EXPECT_LT(off / eye_distance(placed), 0.08) << to_string(f.point.id);
  }
}

TEST_P(FoundPoints, AreEnoughToProposeTheOthers) {
  const SampleHeadTraits& traits = GetParam().traits;
  if (traits.form == SampleHeadForm::scan) return;
  const Model model = sample_head_model(traits);
  const Surface surface = build_surface(model);
  const FeaturePointSet placed = sample_head_points(traits);
  const auto proposals =
      propose_feature_points(surface, describe_parts(model, surface, {}), {}, heads_of_others(), {}, model.triangles);
  ASSERT_TRUE(proposals) << proposals.error().message;
  EXPECT_GE(proposals->points.size(), 80U);
  std::vector<double> off;
  std::size_t within = 0;
  for (const Proposal& p : proposals->points) {
    off.push_back(glm::distance(p.point.position, find_point(placed, p.point.id)->position) / eye_distance(placed));
    within += off.back() <= p.expected_error ? 1 : 0;
  }
  std::sort(off.begin(), off.end());
  EXPECT_LT(off[off.size() / 2], 0.10);
  EXPECT_LT(off[off.size() * 9 / 10], 0.30);
  EXPECT_GE(within * 10, off.size() * 8) << "of the claims";
}

INSTANTIATE_TEST_SUITE_P(Family, FoundPoints, ::testing::ValuesIn(testing::sample_family()), testing::member_name);

TEST(FoundPointsOfOthers, AScanHasNoEyeballs) {
  const auto found = find_on(sample_head_model({.form = SampleHeadForm::scan}));
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().message, "the model has no two eyeballs that are parts of their own");
}

TEST(FoundPointsOfOthers, AHeadThatLooksAsideIsRefused) {
  Model model = sample_head_model();
  for (glm::vec3& p : model.positions) p = {p.z, p.y, -p.x};
  const auto found = find_on(model);
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("not side by side"), std::string::npos) << found.error().message;
}

TEST(FoundPointsOfOthers, MarkedPointsStayAndAreNotProposed) {
  const Model model = sample_head_model();
  const Surface surface = build_surface(model);
  const FeaturePointSet all = sample_head_points();
  const FeaturePointSet marked = {*find_point(all, fp("2.1")), *find_point(all, fp("3.1"))};
  const auto proposals = propose_feature_points(surface, describe_parts(model, surface, marked), marked,
                                                heads_of_others(), {}, model.triangles);
  ASSERT_TRUE(proposals) << proposals.error().message;
  for (const Proposal& p : proposals->points) {
    for (const FeaturePoint& own : marked) {
      EXPECT_NE(p.point.id, own.id);
      EXPECT_FALSE(p.point.vertex && p.point.vertex == own.vertex) << to_string(p.point.id);
    }
  }
}

}  // namespace
}  // namespace semblante

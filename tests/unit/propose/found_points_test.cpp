#include "core/propose/found_points.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
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
  return find_points_by_eyeballs(surface, describe_parts(model, surface, {}), model.triangles, heads_of_others());
}

std::vector<FoundPoint> find_by_likeness(const Model& model) {
  const Surface surface = build_surface(model);
  return find_points_by_likeness(surface, describe_parts(model, surface, {}), model.triangles, heads_of_others());
}

Result<Proposals> propose_by_shape(const Model& model) {
  const Surface surface = build_surface(model);
  return propose_feature_points(surface, describe_parts(model, surface, {}), {}, heads_of_others(), {},
                                model.triangles);
}

Model looking_aside(Model model) {
  for (glm::vec3& p : model.positions) p = {p.z, p.y, -p.x};
  return model;
}

struct Tilt {
  const char* name;
  glm::dvec3 axis;
  double degrees;

  [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& p) const {
    return glm::angleAxis(glm::radians(degrees), axis) * p;
  }
  [[nodiscard]] Model operator()(Model model) const {
    for (glm::vec3& p : model.positions) p = glm::vec3((*this)(glm::dvec3(p)));
    return model;
  }
};
constexpr std::array tilts = {Tilt{"nods", {1.0, 0.0, 0.0}, 30.0},
                              Tilt{"looks up", {1.0, 0.0, 0.0}, -25.0},
                              Tilt{"looks to its left", {0.0, 1.0, 0.0}, 30.0},
                              Tilt{"looks to its right", {0.0, 1.0, 0.0}, -20.0},
                              Tilt{"leans to its right", {0.0, 0.0, 1.0}, 15.0},
                              Tilt{"leans to its left", {0.0, 0.0, 1.0}, -40.0}};

double eye_distance(const FeaturePointSet& points) {
  return glm::distance(find_point(points, fp("3.5"))->position, find_point(points, fp("3.6"))->position);
}

/// As parts of the distance of the eyes.
void expect_found(const std::vector<FoundPoint>& found, const Tilt& tilt, const FeaturePointSet& placed, double bound) {
  for (const FoundPoint& f : found) {
    const glm::dvec3 place = tilt(glm::dvec3(find_point(placed, f.point.id)->position));
    EXPECT_LT(glm::distance(glm::dvec3(f.point.position), place) / eye_distance(placed), bound)
        << tilt.name << ", " << to_string(f.point.id);
  }
}

bool has(const std::vector<FoundPoint>& found, const char* name) {
  return std::any_of(found.begin(), found.end(), [&](const FoundPoint& p) { return p.point.id == fp(name); });
}

struct Bounds {
  double median, nine_in_ten;  ///< of the distances, in ES0
};

/// Also that most of the claims are true.
void expect_near(const Proposals& proposals, const FeaturePointSet& placed, const Bounds& bounds) {
  std::vector<double> off;
  std::size_t within = 0;
  for (const Proposal& p : proposals.points) {
    const FeaturePoint* const there = find_point(placed, p.point.id);
    if (there == nullptr) continue;
    off.push_back(glm::distance(p.point.position, there->position) / eye_distance(placed));
    within += off.back() <= p.expected_error ? 1 : 0;
  }
  std::sort(off.begin(), off.end());
  EXPECT_LT(off[off.size() / 2], bounds.median);
  EXPECT_LT(off[off.size() * 9 / 10], bounds.nine_in_ten);
  EXPECT_GE(within * 10, off.size() * 8) << "of the claims";
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
  const auto proposals = propose_by_shape(sample_head_model(traits));
  ASSERT_TRUE(proposals) << proposals.error().message;
  EXPECT_GE(proposals->points.size(), 80U);
  expect_near(*proposals, sample_head_points(traits), {.median = 0.10, .nine_in_ten = 0.30});
}

TEST_P(FoundPoints, OfTheLikenessAloneLieNearTheirPlaces) {
  const SampleHeadTraits& traits = GetParam().traits;
  const FeaturePointSet placed = sample_head_points(traits);
  const auto found = find_by_likeness(sample_head_model(traits));
  for (const char* name : {"3.5", "3.6", "9.3"}) EXPECT_TRUE(has(found, name)) << name;
  for (const FoundPoint& f : found) {
    const double off = glm::distance(f.point.position, find_point(placed, f.point.id)->position);
    EXPECT_LT(off / eye_distance(placed), 0.25) << to_string(f.point.id);
  }
}

INSTANTIATE_TEST_SUITE_P(Family, FoundPoints, ::testing::ValuesIn(testing::sample_family()), testing::member_name);

TEST(FoundPointsOfOthers, AScanHasNoEyeballs) {
  const auto found = find_on(sample_head_model({.form = SampleHeadForm::scan}));
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().message, "the model has no two eyeballs that are parts of their own");
}

TEST(FoundPointsOfOthers, AHeadWithATiltIsLookedAtFromItsFront) {
  for (const Tilt& tilt : tilts) {
    const auto found = find_on(tilt(sample_head_model()));
    ASSERT_TRUE(found) << tilt.name << ": " << found.error().message;
    EXPECT_GE(found->size(), 15U) << tilt.name;
    expect_found(*found, tilt, sample_head_points(), 0.12);
  }
}

TEST(FoundPointsOfOthers, AFaceWithATiltIsFoundByItsLikeness) {
  const SampleHeadTraits& broad = testing::sample_family()[1].traits;
  for (const Tilt& tilt : tilts) {
    if (&tilt == &tilts.front()) continue;  // this face is then less like the others than the least likeness
    const auto found = find_by_likeness(tilt(sample_head_model(broad)));
    EXPECT_GE(found.size(), 7U) << tilt.name;
    expect_found(found, tilt, sample_head_points(broad), 0.25);
  }
}

TEST(FoundPointsOfOthers, AHeadThatLooksAsideIsRefused) {
  const Model model = looking_aside(sample_head_model());
  const auto found = find_on(model);
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("not side by side"), std::string::npos) << found.error().message;
  EXPECT_TRUE(find_by_likeness(model).empty());
  const auto proposals = propose_by_shape(model);
  ASSERT_FALSE(proposals);
  EXPECT_NE(proposals.error().message.find("turned in its file, and nothing seen from the front is like a face"),
            std::string::npos)
      << proposals.error().message;
}

TEST(FoundPointsOfOthers, AScanIsProposedByItsLikeness) {
  const SampleHeadTraits traits{.form = SampleHeadForm::scan};
  const auto proposals = propose_by_shape(sample_head_model(traits));
  ASSERT_TRUE(proposals) << proposals.error().message;
  EXPECT_GE(proposals->points.size(), 70U);
  expect_near(*proposals, sample_head_points(traits), {.median = 0.20, .nine_in_ten = 0.45});
}

glm::dvec3 left_pupil(const std::vector<FoundPoint>& found) {
  const auto pupil =
      std::find_if(found.begin(), found.end(), [](const FoundPoint& f) { return f.point.id == fp("3.5"); });
  return pupil == found.end() ? glm::dvec3(1e9) : glm::dvec3(pupil->point.position);
}

TEST(FoundPointsOfOthers, TheBackOfAHeadSeenThroughAnEyeIsNoPupil) {
  SampleHeadTraits traits = testing::sample_family()[1].traits;
  traits.form = SampleHeadForm::scan;
  const double es0 = eye_distance(sample_head_points(traits));
  Model model = sample_head_model(traits);
  const glm::dvec3 before = left_pupil(find_by_likeness(model));
  for (Triangle& t : model.triangles) {
    const bool is_at_pupil = std::any_of(t.begin(), t.end(), [&](std::uint32_t v) {
      return glm::distance(glm::dvec3(model.positions[v]), before) < 0.03 * es0;
    });
    if (is_at_pupil) t.fill(t[0]);  // covers nothing; the numbers of the others stay
  }
  EXPECT_LT(glm::distance(left_pupil(find_by_likeness(model)), before), 0.3 * es0);
}

TEST(FoundPointsOfOthers, ThingsWithoutAFaceHaveNone) {
  EXPECT_TRUE(find_by_likeness(testing::make_ball({0.0F, 0.0F, 0.0F}, 1.0F, 40, 40)).empty());
  Model upside_down = sample_head_model({.form = SampleHeadForm::scan});
  for (glm::vec3& p : upside_down.positions) p = {-p.x, -p.y, p.z};
  EXPECT_TRUE(find_by_likeness(upside_down).empty());
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

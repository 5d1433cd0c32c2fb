// What proposals promise on any head, tried on one that is lopsided: nothing may hang on exact symmetry.

#include <algorithm>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/anatomy/part_roles.h"
#include "core/geometry/surface.h"
#include "core/propose/propose.h"
#include "core/propose/quick_set.h"
#include "core/tables/mpeg4.h"
#include "tests/support/sample_head_model.h"

namespace semblante {
namespace {

/// One side fuller and higher than the other, and turned a little.
glm::vec3 lopsided(const glm::vec3& p) {
  return {p.x * (p.x > 0.0F ? 1.03F : 0.98F) + 0.02F * p.z, p.y + 0.03F * p.x, p.z + 0.01F * p.y};
}

struct Head {
  Model model = testing::sample_head_model();
  FeaturePointSet known;
};

Head make_head() {
  Head head;
  for (glm::vec3& p : head.model.positions) p = lopsided(p);
  for (FeaturePoint point : testing::sample_head_points()) {
    if (std::find(quick_set.begin(), quick_set.end(), to_string(point.id)) == quick_set.end()) continue;
    point.position = lopsided(point.position);
    head.known.push_back(point);
  }
  return head;
}

/// By the proportions of the other heads.
std::vector<Proposal> propose(const Head& head) {
  const Surface surface = build_surface(head.model);
  std::vector<ReferenceHead> others;
  for (const ReferenceHead& reference : reference_heads()) {
    if (reference.name != "sample-head") others.push_back(reference);
  }
  const auto proposals =
      propose_feature_points(surface, describe_parts(head.model, surface, head.known), head.known, others);
  EXPECT_TRUE(proposals);
  return proposals ? proposals->points : std::vector<Proposal>{};
}

template <class Move>
Head moved(Head head, Move move) {
  for (glm::vec3& p : head.model.positions) p = move(p);
  for (FeaturePoint& p : head.known) p.position = move(p.position);
  return head;
}

void expect_same_vertices(const std::vector<Proposal>& a, const std::vector<Proposal>& b) {
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 60U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].point.id, b[i].point.id);
    EXPECT_EQ(a[i].point.vertex, b[i].point.vertex) << to_string(a[i].point.id);
    EXPECT_EQ(a[i].confidence, b[i].confidence) << to_string(a[i].point.id);
  }
}

TEST(ProposalProperties, ScaleAndShiftLeaveThem) {
  const Head head = make_head();
  const auto bigger = moved(head, [](const glm::vec3& p) { return 1024.0F * p; });
  const auto elsewhere = moved(head, [](const glm::vec3& p) { return p + glm::vec3(0.5F, -0.25F, 0.125F); });
  expect_same_vertices(propose(head), propose(bigger));
  expect_same_vertices(propose(head), propose(elsewhere));
}

TEST(ProposalProperties, QuarterTurnsLeaveThem) {
  const Head head = make_head();
  const auto lying = moved(head, [](const glm::vec3& p) { return glm::vec3(p.x, p.z, -p.y); });
  const auto turned = moved(head, [](const glm::vec3& p) { return glm::vec3(p.z, p.y, -p.x); });
  // Roles of unnamed parts are guessed upright; those of the sample head have names.
  expect_same_vertices(propose(head), propose(lying));
  expect_same_vertices(propose(head), propose(turned));
}

TEST(ProposalProperties, OrderOfThePointsDoesNotMatter) {
  const Head head = make_head();
  Head shuffled = head;
  std::mt19937 random(3);
  std::shuffle(shuffled.known.begin(), shuffled.known.end(), random);
  expect_same_vertices(propose(head), propose(shuffled));
}

TEST(ProposalProperties, AMirroredHeadHasMirroredProposals) {
  const Head head = make_head();
  Head mirrored = moved(head, [](const glm::vec3& p) { return glm::vec3(-p.x, p.y, p.z); });
  for (Triangle& t : mirrored.model.triangles) std::swap(t[1], t[2]);
  const auto partner = [](FeaturePointId id) { return FeaturePointId(mpeg4::feature_points[id.value()].mirror); };
  for (FeaturePoint& p : mirrored.known) p.id = partner(p.id);
  for (Primitive& p : mirrored.model.primitives) {
    // Names of eyes speak for their roles.
    if (const auto at = p.name.find("left"); at != std::string::npos) {
      p.name.replace(at, 4, "right");
    } else if (const auto other = p.name.find("right"); other != std::string::npos) {
      p.name.replace(other, 5, "left");
    }
  }
  const auto here = propose(head);
  const auto there = propose(mirrored);
  ASSERT_EQ(here.size(), there.size());
  for (const Proposal& a : here) {
    const auto b =
        std::find_if(there.begin(), there.end(), [&](const Proposal& p) { return p.point.id == partner(a.point.id); });
    ASSERT_NE(b, there.end()) << to_string(a.point.id);
    const glm::vec3 image(-b->point.position.x, b->point.position.y, b->point.position.z);
    EXPECT_LT(glm::distance(a.point.position, image), 1e-5F) << to_string(a.point.id);
  }
}

TEST(ProposalProperties, MoreKnownPointsAreNeverMovedNorProposedAgain) {
  Head head = make_head();
  std::mt19937 random(7);
  for (int round = 0; round < 5; ++round) {
    const auto proposals = propose(head);
    if (proposals.empty()) break;
    for (const Proposal& p : proposals) {
      for (const FeaturePoint& k : head.known) EXPECT_NE(p.point.id, k.id);
    }
    head.known.push_back(proposals[random() % proposals.size()].point);
  }
}

}  // namespace
}  // namespace semblante

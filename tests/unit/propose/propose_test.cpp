#include "core/propose/propose.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/anatomy/lid_edge.h"
#include "core/anatomy/part_roles.h"
#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/propose/quick_set.h"
#include "tests/support/meshes.h"
#include "tests/support/sample_head_model.h"

namespace semblante {
namespace {

using testing::fp;

/// The sample head, whose points the references know: what is tested here is how proposals are made and reported.
class Propose : public ::testing::Test {
 protected:
  Propose()
      : model_(testing::sample_head_model()), surface_(build_surface(model_)), all_(testing::sample_head_points()) {}

  [[nodiscard]] FeaturePointSet some(std::span<const std::string_view> names) const {
    FeaturePointSet points;
    for (const FeaturePoint& p : all_) {
      if (std::find(names.begin(), names.end(), to_string(p.id)) != names.end()) points.push_back(p);
    }
    return points;
  }
  [[nodiscard]] Result<Proposals> propose(const FeaturePointSet& known) const {
    return propose_feature_points(surface_, describe_parts(model_, surface_, known), known);
  }
  [[nodiscard]] FeaturePoint& point(const char* name) {
    return *std::find_if(all_.begin(), all_.end(), [&](const FeaturePoint& p) { return p.id == fp(name); });
  }
  [[nodiscard]] double eye_distance() { return glm::distance(point("3.5").position, point("3.6").position); }
  /// With the face about it and its points but the bare positions. `by`: in distances between the eyes.
  void move_right_eye(const glm::dvec3& by) {
    const double unit = eye_distance();
    const glm::dvec3 eye(point("3.6").position);
    for (glm::vec3& p : model_.positions) {
      const double off = glm::length(glm::dvec2(p) - glm::dvec2(eye)) / unit;
      p += glm::vec3(std::exp(-3.0 * off * off * off * off) * unit * by);
    }
    for (FeaturePoint& p : all_) {
      if (p.vertex) p.position = model_.positions[p.vertex->value()];
    }
    surface_ = build_surface(model_);
  }

  /// Lips welded along their rims: the vertices of the lower lip's rim become the nearest ones of the upper lip.
  /// `width`: of the weld, as a share of the height of the lips.
  [[nodiscard]] Model with_welded_lips(float width) {
    Model welded = model_;
    const auto at = [&](const char* name) { return point(name).position; };
    const float reach = width * glm::distance(at("8.1"), at("8.2"));
    std::vector<std::uint32_t> rim;
    for (std::uint32_t v = 0; v < welded.positions.size(); ++v) {
      const glm::vec3& p = welded.positions[v];
      const bool between = p.x < at("2.4").x && p.x > at("2.5").x && std::abs(p.y - at("2.2").y) < reach;
      if (between && p.z > at("2.4").z) rim.push_back(v);
    }
    for (Triangle& t : welded.triangles) {
      for (std::uint32_t& corner : t) {
        if (std::find(rim.begin(), rim.end(), corner) == rim.end()) continue;
        corner = *std::min_element(rim.begin(), rim.end(), [&](std::uint32_t a, std::uint32_t b) {
          const auto column = [&](std::uint32_t v) {
            return std::abs(welded.positions[v].x - welded.positions[corner].x);
          };
          return column(a) < column(b);
        });
      }
    }
    return welded;
  }

  Model model_;
  Surface surface_;
  FeaturePointSet all_;
};

const Proposal* find(const Proposals& proposals, FeaturePointId id) {
  const auto found = std::find_if(proposals.points.begin(), proposals.points.end(),
                                  [&](const Proposal& p) { return p.point.id == id; });
  return found == proposals.points.end() ? nullptr : &*found;
}

TEST_F(Propose, PutsThePivotAtTheJointOfTheHead_IfItCanBeThisHeads) {
  const FeaturePointSet known = some(quick_set);
  const auto pivot = [&](const NeckJoints& joints) {
    const auto proposals =
        propose_feature_points(surface_, describe_parts(model_, surface_, known), known, reference_heads(), joints);
    EXPECT_TRUE(proposals);
    return find(*proposals, fp("7.1"))->point.position;
  };
  const glm::vec3 guess = pivot({});
  const glm::vec3 joint = guess - glm::vec3(0.0F, 0.03F, 0.005F);
  EXPECT_LT(glm::distance(pivot({{}, SkinJoint{"Head", joint}}), joint), 1e-6F);
  EXPECT_EQ(pivot({{}, SkinJoint{"Head", joint + glm::vec3(0.5F, 0.0F, 0.0F)}}), guess) << "of a figure beside it";
}

TEST_F(Propose, FromTheQuickSetGivesOrExplainsEveryOtherPointOnce) {
  const FeaturePointSet known = some(quick_set);
  ASSERT_EQ(known.size(), quick_set.size());
  const auto proposals = propose(known);
  ASSERT_TRUE(proposals) << proposals.error().message;
  std::array<int, feature_point_count> seen{};
  for (const FeaturePoint& p : known) ++seen[p.id.value()];
  for (const Proposal& p : proposals->points) ++seen[p.point.id.value()];
  for (const NotProposed& p : proposals->not_proposed) ++seen[p.id.value()];
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
  std::string names;
  for (const NotProposed& p : proposals->not_proposed) names += to_string(p.id) + ": " + p.reason + "; ";
  ASSERT_EQ(proposals->not_proposed.size(), 1U) << names;
  EXPECT_EQ(to_string(proposals->not_proposed[0].id), "11.5");
  EXPECT_NE(proposals->not_proposed[0].reason.find("hair"), std::string::npos);
  for (const char* const pupil : {"3.5", "3.6"}) {
    const Proposal* const proposed = find(*proposals, fp(pupil));
    EXPECT_TRUE(proposed == nullptr || !proposed->point.vertex) << pupil;
  }
}

TEST_F(Propose, LiesNearThePointsTheHeadWasMadeWith) {
  const auto proposals = propose(some(quick_set));
  ASSERT_TRUE(proposals);
  int near = 0;
  for (const Proposal& p : proposals->points) {
    const auto placed =
        std::find_if(all_.begin(), all_.end(), [&](const FeaturePoint& q) { return q.id == p.point.id; });
    if (glm::distance(p.point.position, placed->position) < 0.15F * 0.064F) ++near;
  }
  EXPECT_GE(near, static_cast<int>(0.85 * static_cast<double>(proposals->points.size())));
}

TEST_F(Propose, NamesTheWayAndTheVertex) {
  const auto proposals = propose(some(quick_set));
  ASSERT_TRUE(proposals);
  const Proposal* const mirrored = find(*proposals, fp("8.4"));
  ASSERT_NE(mirrored, nullptr);
  EXPECT_EQ(mirrored->method, ProposalMethod::mirror);
  EXPECT_EQ(mirrored->confidence, Confidence::high);
  ASSERT_TRUE(mirrored->point.vertex);
  EXPECT_EQ(model_.positions[mirrored->point.vertex->value()], mirrored->point.position);
  EXPECT_EQ(find(*proposals, fp("11.6"))->method, ProposalMethod::shape);
  EXPECT_EQ(find(*proposals, fp("9.12"))->method, ProposalMethod::proportion);
  EXPECT_EQ(find(*proposals, fp("11.3"))->confidence, Confidence::low);
  EXPECT_FALSE(find(*proposals, fp("7.1"))->point.vertex);
}

TEST_F(Propose, PutsTheEdgeOfALid_OnTheLidThatIsAPartOfItsOwn) {
  const auto proposals = propose(some(quick_set));
  ASSERT_TRUE(proposals);
  const Proposal* const lid = find(*proposals, fp("3.2"));
  ASSERT_NE(lid, nullptr);
  const FeaturePoint& placed = *find_point(all_, "3.2");
  ASSERT_NE(surface_.part_of[surface_.surface_of[placed.vertex->value()].value()], PartId(0));
  EXPECT_LT(glm::distance(lid->point.position, placed.position), 0.01F * 0.064F);
  EXPECT_EQ(lid->confidence, Confidence::high) << lid->remark;
}

// On a coarse mesh the most prominent vertex near the chin may be one of the lower lip.
TEST_F(Propose, PutsTheBossOfTheChinBelowTheLowerLip) {
  FeaturePointSet known = some(quick_set);
  const auto at = [](FeaturePointSet& points, const char* name) {
    return std::find_if(points.begin(), points.end(), [&](const FeaturePoint& p) { return p.id == fp(name); });
  };
  const glm::vec3 boss = at(all_, "2.10")->position;
  const glm::vec3 below = glm::mix(boss, at(all_, "2.1")->position, 0.35F);
  std::uint32_t lip = 0;
  for (std::uint32_t v = 0; v < model_.positions.size(); ++v) {
    if (glm::distance(model_.positions[v], below) < glm::distance(model_.positions[lip], below)) lip = v;
  }
  *at(known, "8.2") = {fp("8.2"), VertexId(lip), model_.positions[lip]};
  const auto proposals = propose(known);
  ASSERT_TRUE(proposals);
  const Proposal* const chin = find(*proposals, fp("2.10"));
  ASSERT_NE(chin, nullptr);
  EXPECT_LT(chin->point.position.y, model_.positions[lip].y + 0.03F * 0.064F);
  EXPECT_LT(model_.positions[lip].y, boss.y - 0.05F * 0.064F);
}

// The mirror image of the left lower lid's middle lies on the fold below the right lower lid.
TEST_F(Propose, PutsLidsOnTheirEdges_OfAnEyeThatIsHigherThanTheOther) {
  move_right_eye({0.0, 0.09, 0.0});
  const FeaturePointSet known = some(quick_set);
  const auto proposals = propose_feature_points(surface_, describe_parts(model_, surface_, known), known,
                                                reference_heads(), {}, model_.triangles);
  ASSERT_TRUE(proposals);
  const double open = point("3.2").position.y - point("3.4").position.y;
  for (const char* const name : {"3.2", "3.4"}) {
    const Proposal* const lid = find(*proposals, fp(name));
    ASSERT_NE(lid, nullptr);
    EXPECT_LT(std::abs(lid->point.position.y - point(name).position.y), 0.25 * open) << name;
  }
}

// The mirror images of the left eye's points lie beside the right eye.
TEST_F(Propose, FollowsTheEyeball_OfAnEyeThatIsLowerAndNearerToTheNose) {
  move_right_eye({0.07, -0.16, 0.0});
  const auto proposals = propose(some(quick_set));
  ASSERT_TRUE(proposals);
  for (const char* const name : {"3.2", "3.4", "3.8", "3.10"}) {
    const Proposal* const lid = find(*proposals, fp(name));
    ASSERT_NE(lid, nullptr) << name;
    EXPECT_LT(glm::distance(lid->point.position, point(name).position), 0.08 * eye_distance()) << name;
  }
}

TEST_F(Propose, NothingWhenAllAreKnown) {
  const auto proposals = propose(all_);
  ASSERT_TRUE(proposals);
  EXPECT_TRUE(proposals->points.empty());
  EXPECT_TRUE(proposals->not_proposed.empty());
}

TEST_F(Propose, SaysWhichPartIsMissing) {
  // The skin alone: no teeth, no tongue, no eyes to look at.
  Model skin = model_;
  skin.primitives.resize(1);
  skin.triangles.resize(skin.primitives[0].triangle_count);
  const Surface surface = build_surface(skin);
  const FeaturePointSet known = some(quick_set);
  const auto proposals = propose_feature_points(surface, describe_parts(skin, surface, known), known);
  ASSERT_TRUE(proposals);
  const auto reason = [&](const char* name) {
    for (const NotProposed& p : proposals->not_proposed) {
      if (p.id == fp(name)) return p.reason;
    }
    return std::string();
  };
  EXPECT_EQ(reason("6.1"), "the model has no tongue");
  EXPECT_EQ(reason("9.10"), "the model has no upper teeth");
  const Proposal* const pupil = find(*proposals, fp("3.5"));
  ASSERT_NE(pupil, nullptr);
  EXPECT_FALSE(pupil->point.vertex);
}

TEST_F(Propose, LeavesOutWhatTheModelEndsBefore) {
  // A mask: nothing behind the cheeks.
  Model mask = model_;
  std::erase_if(mask.triangles, [&](const Triangle& t) { return mask.positions[t[0]].z < 0.02F; });
  mask.primitives.assign(1, Primitive{"mask", -1, 0, static_cast<std::uint32_t>(mask.triangles.size())});
  const Surface surface = build_surface(mask);
  FeaturePointSet known = some(quick_set);
  std::erase_if(known, [&](const FeaturePoint& p) { return p.position.z < 0.025F; });
  const auto proposals = propose_feature_points(surface, describe_parts(mask, surface, known), known);
  ASSERT_TRUE(proposals) << proposals.error().message;
  EXPECT_EQ(find(*proposals, fp("11.6")), nullptr);
  EXPECT_EQ(find(*proposals, fp("10.3")), nullptr);
}

TEST_F(Propose, NeverPutsTwoPointsAtOneVertex) {
  FeaturePointSet known = some(quick_set);
  const auto proposals = propose(known);
  ASSERT_TRUE(proposals);
  FeaturePoint there = find(*proposals, fp("8.4"))->point;
  there.id = fp("8.6");
  known.push_back(there);
  const auto again = propose(known);
  ASSERT_TRUE(again);
  const Proposal* const elsewhere = find(*again, fp("8.4"));
  ASSERT_NE(elsewhere, nullptr);
  EXPECT_NE(elsewhere->point.vertex, there.vertex);
}

// On a coarse ear the vertex that is farthest back is its lowest, too.
TEST_F(Propose, LeavesTheVertexAtTheMirrorImageOfAKnownPoint_ToThatPoint) {
  const auto farthest_back = [this](const char* name) {
    return find(*propose(some(quick_set)), fp(name))->point.vertex;
  };
  const auto left = farthest_back("10.3");
  const auto right = farthest_back("10.4");
  point("10.5").vertex = left;
  point("10.5").position = model_.positions[left->value()];
  const auto proposals = propose(some(quick_set));
  ASSERT_TRUE(proposals);
  EXPECT_EQ(find(*proposals, fp("10.6"))->point.vertex, right);
  EXPECT_NE(find(*proposals, fp("10.4"))->point.vertex, right);
}

TEST_F(Propose, IsNotSureOfASideThatTheSurfaceDoesNotTell) {
  const Model welded = with_welded_lips(0.25F);
  const Surface surface = build_surface(welded);
  FeaturePointSet known = some(quick_set);
  std::erase_if(known, [](const FeaturePoint& p) { return p.id == fp("2.2") || p.id == fp("2.3"); });
  const auto proposals = propose_feature_points(surface, describe_parts(welded, surface, known), known);
  ASSERT_TRUE(proposals);
  int doubted = 0;
  for (const Proposal& p : proposals->points) {
    if (p.remark.empty()) continue;
    ++doubted;
    EXPECT_NE(p.confidence, Confidence::high) << to_string(p.point.id);
    EXPECT_NE(p.remark.find("lip"), std::string::npos) << p.remark;
  }
  EXPECT_GE(doubted, 2);
}

// Whoever marked the point on the left half of the lip knew which lip it is.
TEST_F(Propose, PutsAPointOfALipAtTheMirrorImageOfTheOther_WhereTheSurfaceDoesNotShowItsSide) {
  const Model welded = with_welded_lips(0.8F);
  const Surface surface = build_surface(welded);
  FeaturePointSet known = some(quick_set);
  for (const char* const of_left_half : {"2.6", "2.8", "8.5", "8.7", "8.9"}) known.push_back(point(of_left_half));
  const auto proposals = propose_feature_points(surface, describe_parts(welded, surface, known), known);
  ASSERT_TRUE(proposals);
  const Proposal* const proposed = find(*proposals, fp("8.10"));
  ASSERT_NE(proposed, nullptr);
  EXPECT_EQ(proposed->point.vertex, point("8.10").vertex);
  EXPECT_NE(proposed->confidence, Confidence::high);
  EXPECT_NE(proposed->remark.find("upper lip"), std::string::npos) << proposed->remark;
}

// A fold on the edge of its lid would keep the edge back in a blink.
TEST_F(Propose, DoesNotPutTheFoldOfALidOnItsEdge_WhereNothingElseIsNear) {
  const auto edges = find_eye_edges(surface_, surface_points(surface_, all_), 0);
  ASSERT_TRUE(edges.has_value());
  std::set<std::uint32_t> upper;
  for (const auto& way : edges->upper.to_corner)
    for (const SurfaceVertexId v : way) upper.insert(v.value());
  const FeaturePointSet known = some(quick_set);
  const auto of_fine_lid = propose(known);
  ASSERT_TRUE(of_fine_lid);
  const FeaturePoint& of_fold = find(*of_fine_lid, fp("3.13"))->point;
  const glm::dvec3 fold(of_fold.position);
  // A coarse lid: all vertices about its fold become the nearest one of the edge.
  const double reach = 1.6 * glm::distance(fold, edges->upper.middle.position);
  const auto is_of_lid = [&](PartId part) {
    return part == surface_.part_of[*upper.begin()] ||
           part == surface_.part_of[surface_.surface_of[of_fold.vertex->value()].value()];
  };
  Model coarse = model_;
  for (Triangle& t : coarse.triangles) {
    for (std::uint32_t& corner : t) {
      const std::uint32_t v = surface_.surface_of[corner].value();
      const glm::dvec3& place = surface_.positions[v];
      if (upper.contains(v) || !is_of_lid(surface_.part_of[v])) continue;
      if (glm::distance(place, fold) > reach || place.y < edges->upper.middle.position.y) continue;
      const auto off = [&](std::uint32_t u) { return glm::distance(surface_.positions[u], place); };
      const std::uint32_t nearest =
          *std::min_element(upper.begin(), upper.end(), [&](auto a, auto b) { return off(a) < off(b); });
      corner = surface_.file_vertex_of[nearest].value();
    }
  }
  const Surface surface = build_surface(coarse);
  const auto proposals = propose_feature_points(surface, describe_parts(coarse, surface, known), known);
  ASSERT_TRUE(proposals);
  const Proposal* const proposed = find(*proposals, fp("3.13"));
  ASSERT_NE(proposed, nullptr);
  EXPECT_GT(glm::distance(glm::dvec3(proposed->point.position), fold), 0.9 * reach);
}

TEST_F(Propose, RefusesTooFewPointsAndNamesTheNextEight) {
  // Without triangles the shape shows the two pupils alone.
  const FeaturePointSet known = some(std::span(quick_set).first(3));
  const auto proposals = propose(known);
  ASSERT_FALSE(proposals);
  EXPECT_EQ(proposals.error().code, ErrorCode::missing);
  EXPECT_EQ(proposals.error().where, "/points");
  std::string next;
  for (const std::string_view name : std::span(quick_set).subspan(3, 8))
    next += (next.empty() ? "" : ", ") + std::string(name);
  EXPECT_TRUE(proposals.error().message.ends_with("; next of the quick set: " + next)) << proposals.error().message;
  EXPECT_NE(proposals.error().message.find("at least 8"), std::string::npos);
  EXPECT_FALSE(propose({}));
}

TEST_F(Propose, RefusesPointsInOnePlace) {
  FeaturePointSet known = some(quick_set);
  for (FeaturePoint& p : known) p.position = {0.0F, 0.0F, 0.1F};
  const auto proposals = propose(known);
  ASSERT_FALSE(proposals);
  EXPECT_EQ(proposals.error().code, ErrorCode::missing);
}

TEST_F(Propose, BearsAModelWithoutSurface) {
  Model points_only = model_;
  points_only.triangles.clear();
  points_only.primitives.clear();
  const Surface surface = build_surface(points_only);
  const FeaturePointSet known = some(quick_set);
  const auto proposals = propose_feature_points(surface, describe_parts(points_only, surface, known), known);
  ASSERT_TRUE(proposals);
  for (const Proposal& p : proposals->points) EXPECT_FALSE(p.point.vertex);
}

}  // namespace
}  // namespace semblante

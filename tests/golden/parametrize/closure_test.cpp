// Faces that should be shut are shut, and nothing passes through anything: our own head, and those of others where
// their folder is.

#include "tests/support/closure.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include "core/anatomy/lid_edge.h"
#include "core/anatomy/opening_margins.h"
#include "core/anatomy/point_lookup.h"
#include "core/expressions/contact.h"
#include "core/expressions/kernel_rig.h"
#include "tests/support/fold_over.h"
#include "tests/support/posed_face.h"
#include "tests/support/sample_head_model.h"
#include "tests/support/sculpted_eye.h"

namespace semblante {
namespace {

using bench::Closure;
using bench::Opening;
using bench::OpeningKind;
using bench::PosedFace;

/// Heads with eyes and lips that open: a mask has skin across both.
const std::vector<bench::Head>& heads() {
  static const std::vector<bench::Head> all = [] {
    std::vector<bench::Head> some = bench::known_heads();
    std::erase_if(some, [](const bench::Head& head) { return head.name == "mediapipe-canonical"; });
    return some;
  }();
  return all;
}

Closure measure(const PosedFace& face, OpeningKind kind, const semblante_frame& frame) {
  const auto opening = Opening::find(face, kind);
  EXPECT_TRUE(opening.has_value());
  return opening ? opening->measure(face.pose(frame)) : Closure{};
}

TEST(Blink, ShutsTheEyeAlongTheWholeLidAndNoFarther) {
  for (const bench::Head& head : heads()) {
    const PosedFace face(head, WeightMethod::smooth);
    for (const OpeningKind eye : {OpeningKind::left_eye, OpeningKind::right_eye}) {
      const Closure open = measure(face, eye, bench::frame_of(0, 0));
      const Closure shut = measure(face, eye, bench::frame_of({{19, 1024.0F}, {20, 1024.0F}}));
      EXPECT_GT(open.slit, 0.9) << head.name;  // what is measured is there to be seen
      EXPECT_LE(shut.slit, 0.01) << head.name;
      // Lids that keep their distance from the eye's axis press into each other: by half a millimetre at most.
      EXPECT_LE(shut.crossing, 0.055) << head.name;
    }
  }
}

/// The sample head with each eye turned about its pivot by some radians, its outer corner up.
bench::Head head_with_slanted_eyes(float turn) {
  bench::Head head = bench::sample_head();
  const PosedFace straight(head, WeightMethod::smooth);
  const auto slanted = [&](const glm::vec3& p) {
    const bool left = p.x > 0.0F;
    const glm::vec3 from = p - (left ? straight.rig().left_eye_pivot : straight.rig().right_eye_pivot);
    const float ball = straight.rig().lids[0]->ball.back();
    const float share = 1.0F - glm::smoothstep(1.0F, 3.0F, glm::length(glm::vec2(from)) / ball);
    const float angle = (left ? turn : -turn) * share;
    const glm::vec2 turned(std::cos(angle) * from.x - std::sin(angle) * from.y,
                           std::sin(angle) * from.x + std::cos(angle) * from.y);
    return p + glm::vec3(turned - glm::vec2(from), 0.0F);
  };
  for (glm::vec3& p : head.model.positions) p = slanted(p);
  for (FeaturePoint& point : head.points) point.position = slanted(point.position);
  head.surface = build_surface(head.model);
  return head;
}

// Straight down it is farther from lid to lid than between the heights of their middles: a tenth to a fifth was left
// open.
TEST(Blink, ShutsSlantedEyes) {
  for (const float turn : {0.4F, -0.4F}) {
    const bench::Head head = head_with_slanted_eyes(turn);
    const PosedFace face(head, WeightMethod::smooth);
    for (const OpeningKind eye : {OpeningKind::left_eye, OpeningKind::right_eye}) {
      for (const auto& [upper, lower] : {std::pair(512.0F, 512.0F), std::pair(0.0F, 1024.0F)}) {
        const Closure shut = measure(face, eye, bench::frame_of({{19, upper}, {20, upper}, {21, lower}, {22, lower}}));
        EXPECT_LE(shut.slit, 0.04) << turn << ", " << upper;
        EXPECT_LE(shut.crossing, 0.055) << turn << ", " << upper;
      }
    }
  }
}

// IRISD is the mean of both eyes: by it alone the left one would stay open by a fifth.
TEST(Blink, ShutsBothOfTwoUnequalEyes) {
  const bench::Head sample = bench::sample_head();
  bench::Head head = sample;
  head.model.positions = PosedFace(sample, WeightMethod::smooth).pose(bench::frame_of({{20, 400.0F}}));
  for (FeaturePoint& point : head.points) {
    if (point.vertex) point.position = head.model.positions[point.vertex->value()];
  }
  head.surface = build_surface(head.model);
  const PosedFace face(head, WeightMethod::smooth);
  for (const OpeningKind eye : {OpeningKind::left_eye, OpeningKind::right_eye}) {
    EXPECT_LE(measure(face, eye, bench::frame_of({{19, 1024.0F}, {20, 1024.0F}})).slit, 0.02);
    EXPECT_LE(measure(face, eye, bench::frame_of({{19, 512.0F}, {20, 512.0F}, {21, 512.0F}, {22, 512.0F}})).slit, 0.02);
  }
  EXPECT_NEAR(measure(face, OpeningKind::left_eye, bench::frame_of({{19, 512.0F}})).slit, 0.6, 0.1);
}

TEST(Blink, LeavesAnEyeThatIsClosedAtRestAsItIs_AndItOpensInAnArc) {
  std::size_t closed = 0;
  for (const testing::FamilyMember& member : testing::sample_family()) {
    if (!member.traits.closed_eyes) continue;
    ++closed;
    bench::Head head{
        member.name, testing::sample_head_model(member.traits), {}, testing::sample_head_points(member.traits)};
    head.surface = build_surface(head.model);
    const PosedFace face(head, WeightMethod::smooth);
    const double irisd = 1024.0 * *face.rig().fapu[FapuUnit::irisd];
    const auto shut = face.pose(bench::frame_of({{19, 1024.0F}, {20, 1024.0F}, {21, 1024.0F}, {22, 1024.0F}}));
    double farthest = 0.0;
    for (std::size_t v = 0; v < shut.size(); ++v)
      farthest = std::max<double>(farthest, glm::distance(shut[v], head.model.positions[v]));
    const auto left = find_eye_edges(head.surface, surface_points(head.surface, head.points), 0);
    ASSERT_TRUE(left.has_value());
    const double slit = left->upper.middle.position.y - left->lower.middle.position.y;
    EXPECT_LT(slit, 0.1 * irisd) << head.name;
    EXPECT_LT(farthest, 0.1 * irisd) << head.name;  // what there is to close, on a circle
    const auto slit_in = [&](const std::vector<glm::vec3>& pose) {
      const auto y_of = [&](const LidEdge& lid) {
        return pose[head.surface.file_vertex_of[lid.middle.vertex.value()].value()].y;
      };
      return y_of(left->upper) - y_of(left->lower);
    };
    for (std::uint8_t expression = 1; expression < expression_library().size(); ++expression)
      EXPECT_LE(slit_in(face.pose(bench::frame_of(0, expression))), slit + 0.01 * irisd) << head.name;
    const auto open = face.pose(bench::frame_of({{19, -512.0F}, {20, -512.0F}}));
    EXPECT_EQ(bench::count_fold_over(head.model.triangles, head.model.positions, open).inverted, 0U) << head.name;
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const auto edges = find_eye_edges(head.surface, surface_points(head.surface, head.points), eye);
      ASSERT_TRUE(edges.has_value());
      for (const auto& path : edges->upper.to_corner) {
        const SurfaceVertexId halfway = path[path.size() / 2];
        const std::uint32_t v = head.surface.file_vertex_of[halfway.value()].value();
        EXPECT_GT(open[v].y - head.model.positions[v].y, 0.25 * irisd) << head.name;  // of the 0.5 in the middle
      }
    }
  }
  EXPECT_GT(closed, 0U);
}

// The lids' own shape is not Eq. 7's: a fit that were free at their edges would leave a tenth of the eye open.
TEST(Blink, ShutsTheEyeWithWeightsFittedToOwnShapes) {
  std::size_t fitted = 0;
  for (const bench::Head& head : heads()) {
    if (head.model.examples.empty()) continue;
    ++fitted;
    const PosedFace face(head, WeightMethod::fitted);
    for (const OpeningKind eye : {OpeningKind::left_eye, OpeningKind::right_eye}) {
      const Closure shut = measure(face, eye, bench::frame_of({{19, 1024.0F}, {20, 1024.0F}}));
      EXPECT_LE(shut.slit, 0.01) << head.name;
      EXPECT_LE(shut.crossing, 0.055) << head.name;
    }
  }
  if (fitted == 0) GTEST_SKIP() << "no head with shapes of its own";
}

/// y of a path where it passes the vertical plane through `p` along `sight`, horizontal.
std::optional<double> height_behind(const std::vector<glm::dvec3>& path, const glm::dvec3& p, const glm::dvec3& sight) {
  const glm::dvec3 across(sight.z, 0.0, -sight.x);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double from = glm::dot(path[i - 1] - p, across);
    const double to = glm::dot(path[i] - p, across);
    if ((from < 0.0) != (to < 0.0)) return path[i - 1].y + (path[i].y - path[i - 1].y) * from / (from - to);
  }
  return std::nullopt;
}

// An upper lid lies farther in front than the lower one: if it ended at the same height, the eyeball would be seen
// between them from the side.
TEST(Blink, SeenFromTheSide_ShowsNoEyeballAtTheOuterCorner) {
  for (const bench::Head& head : bench::heads_with_lids()) {
    const PosedFace face(head, WeightMethod::smooth);
    const auto moved = face.pose(bench::frame_of({{19, 1024.0F}, {20, 1024.0F}}));
    const double unit = 1024.0 * face.rig().fapu[FapuUnit::irisd].value();
    const std::vector<SurfacePoint> points = surface_points(head.surface, head.points);
    for (const std::size_t eye : {std::size_t{0}, std::size_t{1}}) {
      const auto edges = find_eye_edges(head.surface, points, eye);
      ASSERT_TRUE(edges.has_value()) << head.name;
      const auto shut = [&](const LidEdge& edge) {
        std::vector<glm::dvec3> path;
        for (const SurfaceVertexId at : edge.to_corner[LidEdge::outer]) {
          const auto& all = head.surface.surface_of;
          path.emplace_back(moved[static_cast<std::size_t>(std::find(all.begin(), all.end(), at) - all.begin())]);
        }
        return path;
      };
      const std::vector<glm::dvec3> lower = shut(edges->lower);
      std::size_t measured = 0;
      for (const glm::dvec3& p : shut(edges->upper)) {
        for (const double angle : {0.0, 0.5, 1.0}) {
          const glm::dvec3 sight(eye == 0 ? std::sin(angle) : -std::sin(angle), 0.0, std::cos(angle));
          const auto height = height_behind(lower, p, sight);
          if (!height) continue;
          ++measured;
          EXPECT_LE((p.y - *height) / unit, 0.04) << head.name << ", eye " << eye << ", seen at " << angle;
        }
      }
      EXPECT_GT(measured, 9U) << head.name;
    }
  }
}

struct LidPose {
  const char* name;
  float upper, lower;  ///< shares of the opening, of the left eye
  float slit_at_most, slit_at_least;
};

/// Each with the gaze straight on, 20 degrees up and down: open lids follow it.
constexpr LidPose lid_poses[] = {
    {"upper half", 0.5F, 0.0F, 0.65F, 0.33F},  {"both half", 0.25F, 0.25F, 0.65F, 0.33F},
    {"upper alone", 1.0F, 0.0F, 0.01F, 0.0F},  {"both", 0.7F, 0.3F, 0.01F, 0.0F},
    {"lower alone", 0.0F, 1.0F, 0.025F, 0.0F},
};

TEST(Blink, OfOneEye_ShutsItWhateverTheGaze_AndTheBallIsNeverPierced) {
  constexpr float most = 34907.0F;  // 20 degrees
  for (const bench::Head& head : bench::heads_with_lids()) {
    const PosedFace face(head, WeightMethod::smooth);
    const auto eye = Opening::find(face, OpeningKind::left_eye);
    const auto other = Opening::find(face, OpeningKind::right_eye);
    ASSERT_TRUE(eye && other) << head.name;
    for (const LidPose& pose : lid_poses) {
      for (const float pitch : {-most, 0.0F, most}) {
        const auto moved = face.pose(
            bench::frame_of({{19, 1024.0F * pose.upper}, {21, 1024.0F * pose.lower}, {25, pitch}, {26, pitch}}));
        const Closure c = eye->measure(moved);
        const Closure open = other->measure(moved);
        const std::string words = head.name + ", " + pose.name + ", pitch " + std::to_string(pitch);
        EXPECT_LE(c.slit, pose.slit_at_most) << words;
        EXPECT_GE(c.slit, pose.slit_at_least) << words;
        EXPECT_LE(c.pierced, 0.0) << words;
        EXPECT_LE(open.pierced, 0.0) << words;
        EXPECT_GT(open.slit, 0.5) << words;
      }
    }
  }
}

TEST(Blink, IsHalfDoneHalfWay) {
  for (const bench::Head& head : heads()) {
    const PosedFace face(head, WeightMethod::smooth);
    const Closure half = measure(face, OpeningKind::left_eye, bench::frame_of({{19, 512.0F}, {20, 512.0F}}));
    EXPECT_GT(half.slit, 0.4) << head.name;
    EXPECT_LT(half.slit, 0.6) << head.name;
    EXPECT_EQ(half.crossing, 0.0) << head.name;
  }
}

/// An eye behind lids that are a grid of `columns` by `rows` quads.
struct EyeBehindGrid {
  EyeBehindGrid(int columns, int rows) : EyeBehindGrid(testing::ball_behind_lids(false, columns, rows)) {}
  explicit EyeBehindGrid(testing::SculptedEye of_eye) : eye(std::move(of_eye)) {
    FeaturePointSet points;
    for (const SurfacePoint& p : eye.points)
      points.push_back({p.id, eye.surface.file_vertex_of[p.vertex.value()], glm::vec3(p.position)});
    std::vector<std::optional<PartRole>> roles(eye.surface.part_count());
    roles[eye.surface.part_of[eye.points.front().vertex.value()].value()] = PartRole::skin;
    const auto back = std::min_element(eye.surface.positions.begin(), eye.surface.positions.end(),
                                       [](const glm::dvec3& a, const glm::dvec3& b) { return a.z < b.z; });
    const auto ball = static_cast<std::size_t>(back - eye.surface.positions.begin());
    roles[eye.surface.part_of[ball].value()] = PartRole::left_eye;
    ParametrizeOptions options;
    options.weights = WeightMethod::smooth;
    options.roles_by_user = roles;
    rig = parametrize(eye.model, eye.surface, points, options).value();
  }

  [[nodiscard]] std::vector<glm::vec3> pose(const Rig& of, const semblante_frame& frame) const {
    const KernelRig kernel_rig = make_kernel_rig(of);
    const semblante_rig view = kernel_rig.view();
    semblante_pose pose;
    semblante_evaluate(&view, &frame, &pose);
    const semblante_face face = make_kernel_face(of, &eye.model.positions[0].x);
    std::vector<glm::vec3> moved(eye.model.positions.size());
    semblante_deform(&face, &pose, &moved[0].x);
    return moved;
  }

  [[nodiscard]] std::uint32_t file_vertex(SurfaceVertexId v) const {
    return eye.surface.file_vertex_of[v.value()].value();
  }

  /// The triangles of the lids whose middles are in the ball when the eye is shut.
  [[nodiscard]] std::size_t in_ball(const Rig& of) const {
    const std::vector<glm::vec3> moved = pose(of, bench::frame_of({{19, 1024.0F}}));
    return static_cast<std::size_t>(
        std::count_if(eye.model.triangles.begin(), eye.model.triangles.end(), [&](const Triangle& t) {
          const glm::vec3 middle = (moved[t[0]] + moved[t[1]] + moved[t[2]]) / 3.0F;
          return of.parts[of.part_of_vertex[t[0]].value()].role == PartRole::skin && middle.z > 0.0F &&
                 glm::length(middle) < 0.995 * testing::sculpted_radius;
        }));
  }

  testing::SculptedEye eye;
  Rig rig;
};

// The place of the point stayed where it was: of a coarse head the eye was two fifths open over it.
TEST(LidEdges, MeetAtTheEndOfTheOpening_WhereACornerIsMarkedOnOneLid) {
  constexpr double x = 0.75;
  testing::SculptedEye marked = testing::ball_behind_lids(false, 30, 24);
  marked.mark("3.7", x, -testing::sculpted_edge(x) - 0.03);
  const EyeBehindGrid head(marked);
  const auto edges = find_eye_edges(head.eye.surface, head.eye.points, 0);
  ASSERT_TRUE(edges.has_value());
  const SurfaceVertexId end = edges->upper.to_corner[LidEdge::outer].back();
  EXPECT_EQ(edges->lower.to_corner[LidEdge::outer].back(), end);
  EXPECT_GT(head.eye.surface.positions[end.value()].x, 0.95);
  const std::uint32_t corner = head.file_vertex(head.eye.point("3.7").vertex);
  EXPECT_LT(head.eye.model.positions[corner].y, -testing::sculpted_edge(x));
  EXPECT_GT(head.pose(head.rig, bench::frame_of({{21, 1024.0F}}))[corner].y, 0.9 * testing::sculpted_edge(x));
}

// The edges went along the inside of the lids to the corner: those that are seen did not meet in a blink.
TEST(LidEdges, StayBeforeTheBall_WhereACornerIsMarkedInsideALid) {
  const EyeBehindGrid head(testing::ball_behind_thick_lids());
  const auto edges = find_eye_edges(head.eye.surface, head.eye.points, 0, head.rig.parts);
  ASSERT_TRUE(edges.has_value());
  const auto& lower = edges->lower.to_corner[LidEdge::outer];
  const auto at_rest = [&](SurfaceVertexId v) { return head.eye.surface.positions[v.value()]; };
  const std::vector<glm::vec3> shut = head.pose(head.rig, bench::frame_of({{19, 1024.0F}}));
  std::size_t places = 0;
  for (const MarginSite& site : margin_sites(head.eye.surface, head.eye.points, {}, head.rig.parts)) {
    const glm::dvec3 place = at_rest(site.vertex);
    if (std::abs(place.x) > 0.85) continue;  // at the corners
    EXPECT_GT(glm::length(place), testing::sculpted_radius) << place.x << " " << place.y;
    if (place.x < 0.0 || place.y < 0.0) continue;
    ++places;
    const SurfaceVertexId below = *std::min_element(lower.begin(), lower.end(), [&](auto a, auto b) {
      return std::abs(at_rest(a).x - place.x) < std::abs(at_rest(b).x - place.x);
    });
    EXPECT_NEAR(shut[head.file_vertex(site.vertex)].y, at_rest(below).y, 0.03) << place.x;
  }
  EXPECT_GE(places, 7U);
}

TEST(CoarseLids, RiseFromTheBallThatTheirTrianglesWouldCut) {
  const EyeBehindGrid coarse(8, 6);
  ASSERT_TRUE(coarse.rig.lids[0].has_value());
  EXPECT_GT(coarse.rig.lids[0]->lift, 0.0F);
  Rig flat = coarse.rig;
  flat.lids[0]->lift = 0.0F;
  EXPECT_GT(coarse.in_ball(flat), 12U);
  EXPECT_LT(coarse.in_ball(coarse.rig), 8U);  // beside the corners, where lids hardly move
}

TEST(CoarseLids, OfAFineGridHaveNoNeedToRise) {
  const EyeBehindGrid fine(60, 48);
  ASSERT_TRUE(fine.rig.lids[0].has_value());
  EXPECT_EQ(fine.rig.lids[0]->lift, 0.0F);
  EXPECT_EQ(fine.in_ball(fine.rig), 0U);
}

TEST(CoarseLids, AreNotThoseOfHeadsWithManyVertices) {
  for (const bench::Head& head : bench::heads_with_lids()) {
    const PosedFace face(head, WeightMethod::smooth);
    for (const auto& lids : face.rig().lids) EXPECT_EQ(lids->lift, 0.0F) << head.name;
  }
}

// The mouth of makehuman ends bluntly: at rest it is 5.4 % of MNS0 open right beside its corners, which lips of its
// weights cannot shut without passing through each other farther in.
TEST(PBM, ShutsTheLipsAndStopsThere) {
  for (const bench::Head& head : heads()) {
    const PosedFace face(head, WeightMethod::smooth);
    const Closure shut = measure(face, OpeningKind::mouth, bench::frame_of(1, 0));
    EXPECT_LE(shut.slit, head.name == "makehuman" ? 0.05 : 0.02) << head.name;
    // Lips press flat by lip_give; nothing beyond what that explains.
    EXPECT_LE(shut.crossing, lip_give + 0.02) << head.name;
    EXPECT_GT(measure(face, OpeningKind::mouth, bench::frame_of(10, 0)).slit, 0.2) << head.name;  // a
  }
}

/// Skin before an eyeball, and how deep it is in the ball: the least distance from the pivot as share of the ball's
/// least radius.
struct SkinOnBall {
  std::vector<std::uint32_t> vertices;
  double radius = 0.0;
};

SkinOnBall skin_on_ball(const PosedFace& face, std::size_t eye) {
  SkinOnBall skin;
  const auto& lids = face.rig().lids[eye];
  if (!lids) return skin;
  skin.radius = *std::min_element(lids->ball.begin(), lids->ball.end());
  const glm::vec3 pivot = eye == 0 ? face.rig().left_eye_pivot : face.rig().right_eye_pivot;
  const auto& positions = face.head().model.positions;
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    const double distance = glm::distance(positions[v], pivot);
    if (face.role_of(v) == PartRole::skin && positions[v].z > pivot.z && distance > skin.radius &&
        distance < 1.2 * skin.radius)
      skin.vertices.push_back(v);
  }
  return skin;
}

// As on eyes that reach down to the cheeks: the cheek went through the lower lid, and the ball was seen in it.
TEST(SkinOnTheBall, StaysBeforeItWhateverMovesIt) {
  std::size_t measured = 0;
  for (const bench::Head& head : bench::heads_with_lids()) {
    const PosedFace face(head, WeightMethod::smooth);
    for (const auto& frame : {bench::frame_of({{41, 600}, {42, 600}}), bench::frame_of({{33, -400}, {34, -400}}),
                              bench::frame_of(0, 1), bench::frame_of(0, 5)}) {
      const std::vector<glm::vec3> posed = face.pose(frame);
      for (const std::size_t eye : {0U, 1U}) {
        const SkinOnBall skin = skin_on_ball(face, eye);
        const glm::vec3 pivot = eye == 0 ? face.rig().left_eye_pivot : face.rig().right_eye_pivot;
        for (const std::uint32_t v : skin.vertices) {
          EXPECT_GE(glm::distance(posed[v], pivot), 0.995 * skin.radius) << head.name << " " << v;
          ++measured;
        }
      }
    }
  }
  EXPECT_GT(measured, 0U);
}

TEST(LipGaps, AreWhatIsOpenAtRest) {
  for (const bench::Head& head : heads()) {
    const PosedFace face(head, WeightMethod::smooth);
    ASSERT_TRUE(face.rig().lip_gaps.has_value()) << head.name;
    const double mouth_nose = 1024.0 * face.rig().fapu[FapuUnit::mns].value();
    const Closure rest = measure(face, OpeningKind::mouth, bench::frame_of(0, 0));
    for (const double gap : face.rig().lip_gaps->closing) {
      EXPECT_GE(gap, 0.0) << head.name;
      EXPECT_LE(gap / mouth_nose, rest.slit + 0.01) << head.name;
    }
  }
}

TEST(LipGaps, AreUnknownWithWeightsThatMoveBothLips) {
  for (const bench::Head& head : bench::known_heads()) {
    EXPECT_FALSE(PosedFace(head, WeightMethod::paper).rig().lip_gaps.has_value()) << head.name;
  }
}

TEST(LipGaps, OfAMaskAreThoseOfOneSkin) {
  for (const bench::Head& head : bench::known_heads()) {
    const auto gaps = PosedFace(head, WeightMethod::smooth).rig().lip_gaps;
    ASSERT_TRUE(gaps.has_value()) << head.name;
    EXPECT_EQ(gaps->joined, head.name == "mediapipe-canonical") << head.name;
  }
}

TEST(Closure_Measure, SeesLidsThatStayOpen) {
  const bench::Head head = bench::sample_head();
  const PosedFace face(head, WeightMethod::smooth);
  EXPECT_NEAR(measure(face, OpeningKind::left_eye, bench::frame_of({{19, 768.0F}})).slit, 0.25, 0.1);
  // Past the lower lid: shut, and through it. Lids that roll stop there.
  const PosedFace straight(head, WeightMethod::paper);
  EXPECT_GT(measure(straight, OpeningKind::left_eye, bench::frame_of({{21, 512.0F}, {19, 1024.0F}})).crossing, 0.1);
}

TEST(LowerLip, MovesNoUpperLip) {
  for (const bench::Head& head : heads()) {
    const PosedFace face(head, WeightMethod::smooth);
    EXPECT_LE(bench::leak_to_upper_lip(face).value(), 0.10) << head.name;
  }
}

TEST(FoldOver, CountsTrianglesThatTurn) {
  const std::vector<glm::vec3> rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  std::vector<glm::vec3> moved = rest;
  const std::vector<Triangle> triangles = {{0, 1, 2}, {1, 3, 2}};
  EXPECT_EQ(bench::count_fold_over(triangles, rest, moved).inverted, 0U);
  moved[3] = {0.2F, 0.2F, 0.0F};
  EXPECT_EQ(bench::count_fold_over(triangles, rest, moved).inverted, 1U);
  moved[3] = {0.5F, 0.5F, 0.0F};
  EXPECT_EQ(bench::count_fold_over(triangles, rest, moved).inverted, 0U);
  EXPECT_EQ(bench::count_fold_over(triangles, rest, moved).degenerate, 1U);
}

}  // namespace
}  // namespace semblante

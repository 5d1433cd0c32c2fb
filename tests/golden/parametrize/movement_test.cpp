// Heads in motion: lids that roll on the eyeball, a chin that goes with the jaw, a head that turns on its neck. Our own
// head, and those of others where their folder is.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/fold_over.h"
#include "tests/support/posed_face.h"

namespace semblante {
namespace {

using bench::frame_of;
using bench::Head;
using bench::PosedFace;

const std::vector<Head>& heads_in_motion() {
  static const std::vector<Head> all = bench::known_heads();
  return all;
}

double eye_separation(const PosedFace& face) { return 1024.0 * face.rig().fapu[FapuUnit::es].value(); }
/// One millimetre of a head whose eyes are 63 mm apart.
double millimetre(const PosedFace& face) { return eye_separation(face) / 63.0; }

std::vector<semblante_frame> lid_frames() {
  return {frame_of({{19, 512.0F}, {20, 512.0F}}),
          frame_of({{19, 1024.0F}, {20, 1024.0F}}),
          frame_of({{19, 1024.0F}, {20, 300.0F}, {22, 500.0F}}),
          frame_of({{19, 700.0F}, {20, 700.0F}, {21, 400.0F}, {22, 400.0F}}),
          frame_of({{25, 40000.0F}, {26, 40000.0F}}),
          frame_of({{25, -35000.0F}, {26, -35000.0F}}),
          frame_of({{19, 1024.0F}, {20, 512.0F}, {25, 40000.0F}, {26, -35000.0F}, {23, 30000.0F}, {24, 30000.0F}})};
}

/// How far a place is outside of an eyeball, along the line from the eye's pivot: by the vertices of the ball near that
/// line; infinite where there are none, behind the ball's border.
double outside_of_ball(const std::vector<glm::vec3>& ball, const glm::vec3& pivot, const glm::vec3& p) {
  const glm::dvec3 d = glm::dvec3(p) - glm::dvec3(pivot);
  const double distance = glm::length(d);
  double radius = 0.0;
  for (const glm::vec3& b : ball) {
    const glm::dvec3 r = glm::dvec3(b) - glm::dvec3(pivot);
    if (glm::dot(r, d) > 0.995 * glm::length(r) * distance) radius = std::max(radius, glm::length(r));
  }
  return radius > 0.0 ? distance - radius : std::numeric_limits<double>::infinity();
}

TEST(Lids_Roll, NeverIntoTheBall) {
  for (const Head& head : heads_in_motion()) {
    const PosedFace face(head, WeightMethod::smooth);
    for (const int eye : {0, 1}) {
      if (!face.rig().lids[static_cast<std::size_t>(eye)]) continue;
      const glm::vec3 pivot = eye == 0 ? face.rig().left_eye_pivot : face.rig().right_eye_pivot;
      const PartRole role = eye == 0 ? PartRole::left_eye : PartRole::right_eye;
      const RigidMotion lids = eye == 0 ? RigidMotion::left_lids : RigidMotion::right_lids;
      const auto ball_of = [&](const std::vector<glm::vec3>& vertices) {
        std::vector<glm::vec3> ball;
        for (std::uint32_t v = 0; v < vertices.size(); ++v) {
          if (face.role_of(v) == role) ball.push_back(vertices[v]);
        }
        return ball;
      };
      const std::vector<glm::vec3> rest = face.pose({});
      const std::vector<glm::vec3> ball_at_rest = ball_of(rest);
      for (const semblante_frame& frame : lid_frames()) {
        const std::vector<glm::vec3> moved = face.pose(frame);
        const std::vector<glm::vec3> ball = ball_of(moved);
        double deepest = 0.0;
        std::uint32_t at = 0;
        for (std::uint32_t v = 0; v < rest.size(); ++v) {
          if (face.rig().rigid_of_vertex[v] != lids) continue;
          const double before = outside_of_ball(ball_at_rest, pivot, rest[v]);
          if (!(before >= 0.0) || std::isinf(before)) continue;  // within on the neutral face already, or behind
          if (rest[v].z - pivot.z < 0.4F * glm::distance(rest[v], pivot)) continue;  // the socket beside the ball
          const double after = outside_of_ball(ball, pivot, moved[v]);
          if (after < deepest) at = v;
          deepest = std::min(deepest, after);
        }
        // The deepest are hidden in the socket behind the lids: a ball is not quite round.
        EXPECT_GE(deepest, -0.4 * millimetre(face))
            << head.name << ", eye " << eye << ", vertex " << at << " from " << rest[at].x << ' ' << rest[at].y << ' '
            << rest[at].z << " (" << outside_of_ball(ball_at_rest, pivot, rest[at]) << " outside) to " << moved[at].x
            << ' ' << moved[at].y << ' ' << moved[at].z << " about " << pivot.x << ' ' << pivot.y << ' ' << pivot.z;
      }
    }
  }
}

TEST(Lids_Roll, WithTheirCornersStill) {
  for (const Head& head : heads_in_motion()) {
    const PosedFace face(head, WeightMethod::smooth);
    const std::vector<glm::vec3> rest = face.pose({});
    for (const semblante_frame& frame : lid_frames()) {
      const std::vector<glm::vec3> moved = face.pose(frame);
      for (const FeaturePoint& point : head.points) {
        const std::string id = to_string(point.id);
        if (!point.vertex || (id != "3.7" && id != "3.8" && id != "3.11" && id != "3.12")) continue;
        const std::uint32_t v = point.vertex->value();
        EXPECT_LE(glm::distance(rest[v], moved[v]), 0.25 * millimetre(face)) << head.name << ' ' << id;
      }
    }
  }
}

TEST(Jaw, TakesTheChinAlong) {
  for (const Head& head : heads_in_motion()) {
    const PosedFace face(head, WeightMethod::smooth);
    const auto* const jaw = find_point(head.points, "2.1");
    const auto* const chin = find_point(head.points, "2.10");
    if (jaw == nullptr || chin == nullptr || !jaw->vertex || !chin->vertex) continue;
    const std::vector<glm::vec3> rest = face.pose({});
    const std::vector<glm::vec3> moved = face.pose(frame_of({{3, 600.0F}}));
    const float down = rest[jaw->vertex->value()].y - moved[jaw->vertex->value()].y;
    const float chin_down = rest[chin->vertex->value()].y - moved[chin->vertex->value()].y;
    EXPECT_GT(down, 0.0F) << head.name;
    EXPECT_NEAR(chin_down / down, 1.0F, 0.1F) << head.name;
  }
}

TEST(Mouth, CornersDrawnInwardsDoNotPassTheLipsBesideThem) {
  // Twice as far as in ICT-FaceKit's strongest pucker. Corner, point beside it:
  constexpr std::pair<const char*, const char*> neighbors[] = {{"2.4", "2.6"}, {"2.4", "2.8"}, {"2.5", "2.7"},
                                                               {"2.5", "2.9"}, {"8.3", "8.5"}, {"8.3", "8.7"},
                                                               {"8.4", "8.6"}, {"8.4", "8.8"}};
  for (const Head& head : heads_in_motion()) {
    const PosedFace face(head, WeightMethod::smooth);
    const std::vector<glm::vec3> rest = face.pose({});
    const std::vector<glm::vec3> moved = face.pose(frame_of({{6, -240.0F}, {7, -240.0F}}));
    for (const auto& [corner_id, beside_id] : neighbors) {
      const auto* const corner = find_point(head.points, corner_id);
      const auto* const beside = find_point(head.points, beside_id);
      if (corner == nullptr || beside == nullptr || !corner->vertex || !beside->vertex) continue;
      const auto gap = [&](const std::vector<glm::vec3>& vertices) {
        return vertices[corner->vertex->value()].x - vertices[beside->vertex->value()].x;
      };
      EXPECT_GT(gap(moved) / gap(rest), 0.0F) << head.name << ", from " << corner_id << " to " << beside_id;
    }
  }
}

/// The file vertices below the chin where the skin of a face ends: of a cut neck, of a bust, in a collar.
std::vector<std::uint32_t> border_below_chin(const PosedFace& face) {
  const Head& head = face.head();
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> triangles_of_edge;
  for (const Triangle& t : head.model.triangles) {
    if (face.role_of(t[0]) != PartRole::skin) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = head.surface.surface_of[t[i]].value();
      const std::uint32_t b = head.surface.surface_of[t[(i + 1) % 3]].value();
      ++triangles_of_edge[std::minmax(a, b)];
    }
  }
  const auto* const chin = find_point(head.points, "2.1");
  std::vector<std::uint32_t> border;
  for (const auto& [edge, count] : triangles_of_edge) {
    if (count != 1) continue;
    for (const std::uint32_t s : {edge.first, edge.second}) {
      if (head.surface.positions[s].y < chin->position.y - 0.2 * eye_separation(face))
        border.push_back(head.surface.file_vertex_of[s].value());
    }
  }
  return border;
}

TEST(Neck, StaysWhereTheSkinEnds) {
  int with_neck = 0;
  for (const Head& head : heads_in_motion()) {
    const PosedFace face(head, WeightMethod::smooth);
    if (face.rig().turn_of_vertex.empty()) continue;
    ++with_neck;
    const std::vector<std::uint32_t> border = border_below_chin(face);
    ASSERT_FALSE(border.empty()) << head.name;
    const std::vector<glm::vec3> rest = face.pose({});
    for (const semblante_frame& frame : bench::head_turns()) {
      const std::vector<glm::vec3> moved = face.pose(frame);
      for (const std::uint32_t v : border) {
        ASSERT_LE(glm::distance(rest[v], moved[v]), millimetre(face)) << head.name << ", vertex " << v;
      }
    }
  }
  EXPECT_GT(with_neck, 0);
}

TEST(Neck, DoesNotFold) {
  for (const Head& head : heads_in_motion()) {
    const PosedFace face(head, WeightMethod::smooth);
    if (face.rig().turn_of_vertex.empty()) continue;
    const std::vector<Triangle> neck = bench::neck_triangles(face);
    ASSERT_FALSE(neck.empty()) << head.name;
    const std::vector<glm::vec3> rest = face.pose({});
    for (const semblante_frame& frame : bench::head_turns()) {
      const std::size_t folded = bench::count_fold_over(neck, rest, face.pose(frame)).inverted;
      EXPECT_EQ(folded, 0U) << head.name << ", " << neck.size() << " triangles, FAPs 48 to 50: " << frame.fap[48] << ' '
                            << frame.fap[49] << ' ' << frame.fap[50];
    }
  }
}

}  // namespace
}  // namespace semblante

// The neck's joints of a skeleton as a hint for the turn of the head: the family's body with and without them.
#include <algorithm>
#include <array>
#include <cstdio>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/anatomy/neck.h"
#include "core/import/import.h"
#include "tests/support/fold_over.h"
#include "tests/support/posed_face.h"
#include "tests/support/sample_head_model.h"
#include "tests/support/sample_shapes.h"

namespace semblante {
namespace {

using bench::Head;
using bench::PosedFace;

/// The body from its file, without the marked pivot 7.1, which would be used instead of the joint of the head.
Head body(bool with_joints) {
  auto model = import_model(testing::sample_avatar_glb(), ModelFormat::glb);
  EXPECT_TRUE(model);
  Head head{with_joints ? "with joints" : "without", *std::move(model), {}, {}};
  if (!with_joints) head.model.neck_joints = {};
  head.surface = build_surface(head.model);
  head.points = testing::sample_head_points({.form = SampleHeadForm::body});
  std::erase_if(head.points, [](const FeaturePoint& point) { return to_string(point.id) == "7.1"; });
  return head;
}

constexpr float neck_joint_y = -0.175F;
constexpr glm::vec3 head_joint(0.0F, -0.09F, -0.025F);

struct Turn {
  double lowest = 0.0;     ///< y down to which the skin takes part
  double shoulders = 0.0;  ///< mm, the farthest
  std::size_t folded = 0, neck = 0;
};

/// Over all turns: how far what hangs on the shoulders moves, and triangles of the neck that fold.
Turn turn_of(const PosedFace& face) {
  const std::vector<Triangle> neck = bench::neck_triangles(face);
  const std::vector<glm::vec3> rest = face.pose({});
  Turn result;
  result.neck = neck.size();
  for (std::uint32_t v = 0; v < rest.size(); ++v) {
    if (face.role_of(v) == PartRole::skin && face.rig().turn_of_vertex[v] > 0)
      result.lowest = std::min<double>(result.lowest, rest[v].y);
  }
  for (const semblante_frame& frame : bench::head_turns()) {
    const std::vector<glm::vec3> moved = face.pose(frame);
    result.folded += bench::count_fold_over(neck, rest, moved).inverted;
    for (std::uint32_t v = 0; v < rest.size(); ++v) {
      // The collar bones of the figure are 19 cm below its eyes, and the arms hang from there.
      if (rest[v].y < -0.19F) result.shoulders = std::max(result.shoulders, 1000.0 * glm::distance(rest[v], moved[v]));
    }
  }
  return result;
}

TEST(NeckJoints, TurnTheHeadOfABody) {
  std::array<Turn, 2> turns;
  for (const bool joints : {false, true}) {
    const Head head = body(joints);
    const PosedFace face(head, WeightMethod::smooth);
    ASSERT_FALSE(face.rig().turn_of_vertex.empty());
    const glm::vec3 pivot = face.rig().head_pivot;
    EXPECT_EQ(glm::distance(pivot, head_joint) < 1e-6F, joints);
    const Turn turn = turns[joints ? 1 : 0] = turn_of(face);
    std::printf(
        "%-12s pivot %.1f mm from the joint; skin turns down to %.1f mm above the neck's joint; shoulders %.3f mm; "
        "%zu of %zu triangles of the neck fold\n",
        head.name.c_str(), 1000.0 * static_cast<double>(glm::distance(pivot, head_joint)),
        1000.0 * (turn.lowest - static_cast<double>(neck_joint_y)), turn.shoulders, turn.folded, turn.neck);
    EXPECT_LE(turn.shoulders, 1.0);
    EXPECT_EQ(turn.folded, 0U);
  }
  EXPECT_NEAR(turns[0].lowest, turns[1].lowest, 1e-3) << "the measured shoulders are near the joint";
}

// Feature points alone can place the pivot badly: without pupils it is a guess from the skin's box, which is not cut at
// the neck here.
TEST(NeckJoints, ReplaceAGuessFromTheBoxOfTheSkin) {
  for (const bool joints : {false, true}) {
    Head head = body(joints);
    std::erase_if(head.points, [](const FeaturePoint& point) {
      return to_string(point.id) == "3.5" || to_string(point.id) == "3.6";
    });
    const PosedFace face(head, WeightMethod::smooth);
    const double off = glm::distance(face.rig().head_pivot, head_joint);
    std::printf("%-12s without pupils: pivot %.1f mm from the joint\n", head.name.c_str(), 1000.0 * off);
    EXPECT_EQ(off < 1e-6, joints);
    EXPECT_LE(turn_of(face).shoulders, 1.0);
    EXPECT_EQ(turn_of(face).folded, 0U);
  }
}

}  // namespace
}  // namespace semblante

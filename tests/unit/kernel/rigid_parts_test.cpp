// The kernel moves vertices of head, eyes, lids, pupils and tongue as computed by hand.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/kernel/semblante_kernel.h"
#include "tests/unit/kernel/kernel_rig.h"

namespace semblante::testing {
namespace {

TEST(Kernel_Head, TurnsAsTheWordsOfTheStandardSay) {
  TestRig rig;
  semblante_frame frame{};
  frame.fap[48] = quarter_turn;  // pitch, positive down: the nose goes down
  expect_near(one_vertex(rig, frame, {0, 0, 1}), {0, -1, 0});
  frame = {};
  frame.fap[49] = quarter_turn;  // yaw, positive to the face's left: the nose goes to +X
  expect_near(one_vertex(rig, frame, {0, 0, 1}), {1, 0, 0});
  frame = {};
  frame.fap[50] = quarter_turn;  // roll, positive to the face's right: the crown goes to -X
  expect_near(one_vertex(rig, frame, {0, 1, 0}), {-1, 0, 0});
}

TEST(Kernel_Head, RollsThenPitchesThenYaws_AboutItsPivot) {
  TestRig rig;
  rig.rig.head_pivot[1] = 10.0F;
  semblante_frame frame{};
  frame.fap[48] = frame.fap[49] = frame.fap[50] = quarter_turn;
  // Crown (0,1,0) above the pivot: roll -> (-1,0,0); pitch about x leaves it; yaw about y: (-1,0,0) -> (0,0,1).
  expect_near(one_vertex(rig, frame, {0, 11, 0}), {0, 10, 1});
}

TEST(Kernel_Eyes, TurnAboutTheirOwnPivots_AndLeaveTheSkin) {
  TestRig rig;
  rig.rig.eye_pivot[0][0] = 3.0F;
  rig.rig.eye_pivot[1][0] = -3.0F;
  semblante_frame frame{};
  frame.fap[23] = quarter_turn;  // left eye to the left: its pupil goes to +X
  frame.fap[26] = quarter_turn;  // right eye down
  expect_near(one_vertex(rig, frame, {3, 0, 1}, 1), {4, 0, 0});
  expect_near(one_vertex(rig, frame, {-3, 0, 1}, 2), {-3, -1, 0});
  expect_near(one_vertex(rig, frame, {3, 0, 1}, 0), {3, 0, 1});
}

TEST(Kernel_Eyes, AreThrustForwardAsAWhole_ThenTurnWithTheHead) {
  TestRig rig;
  semblante_frame frame{};
  frame.fap[27] = 1.5F;  // 1.5 * ES = 3 forward
  expect_near(one_vertex(rig, frame, {3, 0, 1}, 1), {3, 0, 4});
  expect_near(one_vertex(rig, frame, {3, 0, 1}, 2), {3, 0, 1});
  frame.fap[49] = quarter_turn;  // the head turns after the eyes: (3, 0, 4) -> (4, 0, -3)
  expect_near(one_vertex(rig, frame, {3, 0, 1}, 1), {4, 0, -3});
}

/// Lids of the left eye: the pivot at the origin, the slit half a radian and 4 high.
TestRig& with_lids(TestRig& rig) {
  rig.rig.lids[0] = {{0, 0, 1}, 0.5F, 4.0F, {0.5F, 0.25F}, {}, 0.0F};
  return rig;
}

/// Where a vertex of the left lids goes that follows one of their points.
std::vector<float> on_lid(const TestRig& rig, const semblante_frame& frame, std::vector<float> at, int point,
                          float weight = 1.0F) {
  const std::uint32_t offsets[2] = {0, 1};
  const auto id = static_cast<std::uint8_t>(point);
  const std::uint8_t rigid = SEMBLANTE_RIGID_LEFT_LIDS;
  const semblante_face face = {1, at.data(), offsets, &id, &weight, &rigid, nullptr};
  const semblante_pose pose = rig.pose(frame);
  std::vector<float> out(3);
  semblante_deform(&face, &pose, out.data());
  return out;
}

/// On a circle of radius 10 about the eye's axis.
std::vector<float> on_circle(float x, double y) {
  return {x, static_cast<float>(y), static_cast<float>(std::sqrt(100.0 - y * y))};
}

TEST(Kernel_Lids, SlideRoundTheEye_ToTheHeightOfEq7_AndMeet) {
  TestRig rig;
  with_lids(rig);
  semblante_frame frame{};
  frame.fap[19] = 8.0F;  // 8 * IRISD = 4 = the opening
  for (const float weight : {1.0F, 0.75F, 0.25F, 0.0F}) {
    expect_near(on_lid(rig, frame, on_circle(2.0F, 3.0), upper_lid, weight), on_circle(2.0F, 3.0 - 4.0 * weight),
                1e-5F);
  }
  frame.fap[19] = 6.0F;
  frame.fap[21] = 6.0F;  // each lid closes by three quarters: they meet half way and do not cross
  expect_near(on_lid(rig, frame, on_circle(0.0F, 3.0), upper_lid), on_circle(0.0F, 1.0), 1e-5F);
  expect_near(on_lid(rig, frame, on_circle(0.0F, -1.0), lower_lid), on_circle(0.0F, 1.0), 1e-5F);
}

TEST(Kernel_Lids, OfAnEyeThatIsClosedAtRest_CloseNoFarther_AndOpen) {
  TestRig rig;
  with_lids(rig);
  rig.rig.lids[0].slit = 0.001F;
  rig.rig.lids[0].opening = 0.01F;
  semblante_frame frame{};
  frame.fap[19] = 8.0F;
  frame.fap[21] = 8.0F;
  expect_near(on_lid(rig, frame, on_circle(0.0F, 3.0), upper_lid), on_circle(0.0F, 3.0), 0.011F);
  expect_near(on_lid(rig, frame, on_circle(0.0F, 3.0), lower_lid), on_circle(0.0F, 3.0), 0.011F);
  frame.fap[19] = -2.0F;  // IRISD
  frame.fap[21] = 0.0F;
  expect_near(on_lid(rig, frame, on_circle(0.0F, 3.0), upper_lid), on_circle(0.0F, 4.0), 1e-4F);
  frame.fap[19] = -1000.0F;  // the slit is 0.75 radians at most
  expect_near(on_lid(rig, frame, on_circle(0.0F, -1.0), upper_lid), on_circle(0.0F, -1.0 + 0.01 * 749.0), 1e-3F);
}

// IRISD is the mean of both eyes: the wider one would stay open.
TEST(Kernel_Lids, OfTheWiderOfTwoUnequalEyes_AreShutBy1024) {
  TestRig rig;
  with_lids(rig);
  rig.rig.fapu[0] = 3.0F / 1024.0F;  // IRISD
  semblante_frame frame{};
  frame.fap[19] = 1024.0F;
  expect_near(on_lid(rig, frame, on_circle(0.0F, 3.0), upper_lid), on_circle(0.0F, -1.0), 1e-5F);
  frame.fap[19] = 512.0F;
  expect_near(on_lid(rig, frame, on_circle(0.0F, 3.0), upper_lid), on_circle(0.0F, 1.0), 1e-5F);
  frame.fap[19] = 0.0F;
  frame.fap[21] = 1024.0F;
  expect_near(on_lid(rig, frame, on_circle(0.0F, -1.0), lower_lid), on_circle(0.0F, 3.0), 1e-5F);
}

// The eyes of cartoons: a lid that opened by half of such a slit would leave the eyeball and show what is behind it.
TEST(Kernel_Lids, OfAWideEye_OpenToOneRadianFromItsMiddle) {
  TestRig rig;
  with_lids(rig);
  semblante_frame frame{};
  frame.fap[19] = -1000.0F;
  const auto opened = [&](float slit) {
    rig.rig.lids[0].slit = slit;
    return on_lid(rig, frame, on_circle(0.0F, 3.0), upper_lid)[1] - 3.0F;
  };
  EXPECT_NEAR(opened(0.8F), 0.75F * 4.0F, 1e-5F);
  EXPECT_NEAR(opened(1.6F), (1.0F / 1.6F - 0.5F) * 4.0F, 1e-5F);
  EXPECT_NEAR(opened(2.4F), 0.0F, 1e-5F);
}

TEST(Kernel_Lids, FollowTheGaze_AsFarAsTheyAreOpen) {
  TestRig rig;
  with_lids(rig);
  semblante_frame frame{};
  frame.fap[25] = 20000.0F;  // 0.2 rad down: 0.4 of the slit
  expect_near(on_lid(rig, frame, on_circle(0.0F, 3.0), upper_lid), on_circle(0.0F, 2.2), 1e-5F);
  expect_near(on_lid(rig, frame, on_circle(0.0F, -1.0), lower_lid), on_circle(0.0F, -1.4), 1e-5F);
  frame.fap[19] = 8.0F;  // shut stays shut, wherever the eye looks
  expect_near(on_lid(rig, frame, on_circle(0.0F, 3.0), upper_lid), on_circle(0.0F, -1.0), 1e-5F);
}

// The edge of a lid that looks up passed its fold, which stayed where it was.
TEST(Kernel_Lids, ThatFollowTheGaze_TakeTheirFoldsAlong) {
  TestRig rig;
  with_lids(rig);
  const semblante_companion follows{fold, upper_lid, 0, 0, 0.5F};
  rig.rig.companion = &follows;
  rig.rig.companion_count = 1;
  semblante_frame frame{};
  frame.fap[25] = -20000.0F;  // 0.2 rad up: the lid rises by 0.2 of the slit
  semblante_pose pose;
  semblante_evaluate(&rig.rig, &frame, &pose);
  EXPECT_NEAR(pose.fp[upper_lid * 3 + 1], 0.8F, 1e-5F);
  EXPECT_NEAR(pose.fp[fold * 3 + 1], 0.4F, 1e-5F);
}

// Lids of few vertices are flat between them, so these go round the ball in a greater arc.
TEST(Kernel_Lids, RiseFromTheBallWithTheirWay_ByTheirLift) {
  TestRig rig;
  with_lids(rig);
  for (float& radius : rig.rig.lids[0].ball) radius = 9.9F;
  rig.rig.lids[0].lift = 0.5F;
  const auto distance_at = [&](float share) {
    semblante_frame frame{};
    frame.fap[19] = 8.0F * share;
    const auto at = on_lid(rig, frame, on_circle(0.0F, 3.0), upper_lid);
    return std::hypot(at[0], at[1], at[2]);
  };
  EXPECT_NEAR(distance_at(0.0F), 10.0F, 1e-5F);
  EXPECT_NEAR(distance_at(0.5F), 1.03F * 9.9F + 0.5F * 2.0F, 1e-4F);
  EXPECT_NEAR(distance_at(1.0F), 1.03F * 9.9F + 0.5F * 4.0F, 1e-4F);
}

TEST(Kernel_Lids, KeepOffTheBall_AndStayWhereTheyLieWithin) {
  TestRig rig;
  with_lids(rig);
  for (float& radius : rig.rig.lids[0].ball) radius = 9.8F;
  std::fill_n(rig.rig.lids[0].ball, 4, 12.0F);  // a cornea, in front
  const semblante_frame neutral{};
  expect_near(on_lid(rig, neutral, on_circle(0.0F, 1.0), upper_lid), on_circle(0.0F, 1.0));
  semblante_frame frame{};
  frame.fap[19] = 8.0F;
  const std::vector<float> shut = on_lid(rig, frame, on_circle(0.0F, 5.0), upper_lid);
  EXPECT_NEAR(std::hypot(shut[1], shut[2]), 12.294, 1e-3);
  EXPECT_NEAR(shut[1], 1.0, 1e-5);  // forwards, at its height
}

TEST(Kernel_Head, TurnsAVertexByItsShare) {
  TestRig rig;
  semblante_frame frame{};
  frame.fap[49] = quarter_turn;
  const semblante_pose pose = rig.pose(frame);
  const float at[9] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
  const std::uint32_t offsets[4] = {0, 0, 0, 0};
  const std::uint8_t turn[3] = {0, 128, 255};
  const semblante_face face = {3, at, offsets, nullptr, nullptr, nullptr, turn};
  float out[9];
  semblante_deform(&face, &pose, out);
  EXPECT_EQ(out[0], 0.0F);
  EXPECT_EQ(out[2], 1.0F);
  EXPECT_NEAR(std::atan2(out[3], out[5]), std::numbers::pi / 4, 0.01);
  EXPECT_NEAR(std::hypot(out[3], out[5]), 1.0, 1e-6);  // about the axis, not through it
  EXPECT_NEAR(out[6], 1.0F, 1e-6F);
}

/// Looks along +z, pupil 1 and iris 3 wide, eyes at x = 10 and -10; the left one curves back like a ball of radius 5.
TestRig& with_irises(TestRig& rig) {
  for (int eye = 0; eye < 2; ++eye) {
    rig.rig.eye_pivot[eye][0] = eye == 0 ? 10.0F : -10.0F;
    rig.rig.iris[eye] = {{0, 0, 1}, 1.0F, 3.0F, eye == 0 ? -0.1F : 0.0F};
  }
  return rig;
}

TEST(Kernel_Pupils, GrowByTheDiameterInIrisWidths_AndLeaveTheIrisRimAndTheBall) {
  TestRig rig;
  with_irises(rig);
  semblante_frame frame{};
  frame.fap[30] = 2.0F;                                               // 2 * IRISD = 1 wider: half a unit on each side
  expect_near(one_vertex(rig, frame, {-9, 0, 5}, 4), {-8.5F, 0, 5});  // the pupil's rim
  expect_near(one_vertex(rig, frame, {-10, -0.5F, 5}, 4), {-10, -0.75F, 5});  // half way out: half as much
  expect_near(one_vertex(rig, frame, {-10, 2, 5}, 4), {-10, 2.25F, 5});       // half way to the iris' rim likewise
  for (const float r : {0.0F, 3.0F, 4.0F}) {
    expect_near(one_vertex(rig, frame, {-10, r, 5}, 4), {-10, r, 5}, 0.0F);
  }
  expect_near(one_vertex(rig, frame, {-9, 0, 5}, 2), {-9, 0, 5}, 0.0F);  // of the eye, but not of its iris
  expect_near(one_vertex(rig, frame, {11, 0, 5}, 3), {11, 0, 5}, 0.0F);  // the other eye
  frame = {};
  frame.fap[29] = -2.0F;
  // Inwards from radius 1 to 0.5 on a surface that falls away by 0.1 r^2: 0.075 farther out of the eye.
  expect_near(one_vertex(rig, frame, {11, 0, 5}, 3), {10.5F, 0, 5.075F});
}

TEST(Kernel_Pupils, KeepADotOfPupilAndARingOfIris) {
  TestRig rig;
  with_irises(rig);
  semblante_frame frame{};
  frame.fap[30] = 1e6F;
  expect_near(one_vertex(rig, frame, {-9, 0, 5}, 4), {-7.2F, 0, 5});
  frame.fap[30] = -1e6F;
  expect_near(one_vertex(rig, frame, {-9, 0, 5}, 4), {-9.9F, 0, 5});
  rig.rig.fapu[0] = 0.0F;  // IRISD is unknown
  expect_near(one_vertex(rig, frame, {-9, 0, 5}, 4), {-9, 0, 5}, 0.0F);
  rig.rig.fapu[0] = 0.5F;
  rig.rig.iris[1] = {};  // no iris is known
  expect_near(one_vertex(rig, frame, {-9, 0, 5}, 4), {-9, 0, 5}, 0.0F);
}

TEST(Kernel_Pupils, GrowBeforeTheEyeTurns) {
  TestRig rig;
  with_irises(rig);
  semblante_frame frame{};
  frame.fap[30] = 2.0F;
  frame.fap[24] = quarter_turn;  // to +X: what was in front is now at the left, what was left is behind
  expect_near(one_vertex(rig, frame, {-9, 0, 5}, 4), {-5, 0, -1.5F});
}

TEST(Kernel_Tongue, RollsItsBordersUpAboutItsMiddleLine) {
  TestRig rig;
  rig.rig.tongue = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2.0F, 2.0F};
  semblante_frame frame{};
  frame.fap[47] = quarter_turn;
  // A quarter circle of length 2 has radius 4 / pi; a point 0.5 above the sheet is so much nearer to its centre.
  const float radius = 4.0F / 3.14159265F;
  expect_near(one_vertex(rig, frame, {2, 0, 7}, 255), {radius, radius, 7});
  expect_near(one_vertex(rig, frame, {-2, 0.5F, 7}, 255), {-(radius - 0.5F), radius, 7});
  expect_near(one_vertex(rig, frame, {3, 0, 7}, 255), {radius, radius + 1, 7});  // beyond the border: straight on
  expect_near(one_vertex(rig, frame, {0, 0.5F, 7}, 255), {0, 0.5F, 7});          // the middle stays
  expect_near(one_vertex(rig, frame, {2, 0, 7}, 0), {2, 0, 7}, 0.0F);
  // Half the share is half the angle.
  const float r = 2.0F * radius;
  expect_near(one_vertex(rig, frame, {2, 0, 7}, 191), {r * std::sqrt(0.5F), r * (1 - std::sqrt(0.5F)), 7}, 1e-5F);
  frame.fap[47] = -quarter_turn;
  expect_near(one_vertex(rig, frame, {2, 0, 7}, 255), {radius, -radius, 7});
  rig.rig.tongue.roll_limit = 0.0F;
  expect_near(one_vertex(rig, frame, {2, 0, 7}, 255), {2, 0, 7}, 0.0F);
}

}  // namespace
}  // namespace semblante::testing

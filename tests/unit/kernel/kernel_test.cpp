// The kernel against hand-computed cases and against the literal oracle.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/kernel/semblante_kernel.h"
#include "core/tables/mpeg4.h"
#include "tests/oracle/kernel_oracle.h"

extern "C" unsigned semblante_frame_bytes_in_c(void);

namespace {

namespace mpeg4 = semblante::mpeg4;
namespace oracle = semblante::oracle;

/// A rig with zeroed displacement sets that a test fills in.
struct TestRig {
  std::vector<float> viseme = std::vector<float>(15 * 84 * 3);
  std::vector<float> expression = std::vector<float>(7 * 84 * 3);
  semblante_rig rig{};

  TestRig() {
    rig.viseme = viseme.data();
    rig.expression = expression.data();
    const float fapu[5] = {0.5F, 2.0F, 4.0F, 8.0F, 16.0F};  // IRISD ES ENS MNS MW: powers of two, exact products
    std::memcpy(rig.fapu, fapu, sizeof fapu);
    rig.viseme_share = 0.75F;  // not 0.85: the share is the rig's, and 0.75 is exact in binary
  }
  TestRig(const TestRig&) = delete;
  TestRig& operator=(const TestRig&) = delete;

  semblante_pose pose(const semblante_frame& frame) const {
    semblante_pose pose;
    std::memset(&pose, 0xFF, sizeof pose);  // NaN everywhere: evaluate must write all of it
    semblante_evaluate(&rig, &frame, &pose);
    return pose;
  }
};

float& component(std::vector<float>& table, int entry, int fp, int axis) {
  return table[static_cast<std::size_t>((entry * 84 + fp) * 3 + axis)];
}

constexpr float quarter_turn = 157079.63F;  // AU

TEST(Kernel_Header, IsC) { EXPECT_EQ(semblante_frame_bytes_in_c(), sizeof(semblante_frame)); }

TEST(Kernel_Sincos, IsWithin1e7OfTheTruth) {
  double worst = 0.0;
  for (int i = -400000; i <= 400000; ++i) {
    const float angle = static_cast<float>(i) * 1e-4F;
    float s = 0;
    float c = 0;
    semblante_sincos(angle, &s, &c);
    worst = std::max({worst, std::abs(s - std::sin(static_cast<double>(angle))),
                      std::abs(c - std::cos(static_cast<double>(angle)))});
  }
  EXPECT_LT(worst, 1e-7);
}

TEST(Kernel_Sincos, IsNoTurn_WhenTheAngleMakesNoSense) {
  for (const float angle : {std::nanf(""), INFINITY, -INFINITY, 1e20F}) {
    float s = 5;
    float c = 5;
    semblante_sincos(angle, &s, &c);
    EXPECT_EQ(s, 0.0F);
    EXPECT_EQ(c, 1.0F);
  }
}

TEST(Kernel_Evaluate, GivesTheNeutralPose_ForTheZeroFrame) {
  TestRig rig;
  component(rig.viseme, 3, 5, 1) = 1.0F;
  component(rig.expression, 2, 5, 1) = 1.0F;
  const semblante_pose pose = rig.pose({});
  for (const float d : pose.fp) EXPECT_EQ(d, 0.0F);
  for (int eye = 0; eye < 2; ++eye) {
    EXPECT_EQ(pose.eye_rotation[eye][3], 1.0F);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(pose.eye_rotation[eye][i] + pose.eye_translation[eye][i], 0.0F);
  }
  EXPECT_EQ(pose.head_rotation[3], 1.0F);
}

TEST(Kernel_Eq5, SharesAPointThatBothMove_AndKeepsTheOthersWhole) {
  TestRig rig;
  component(rig.viseme, 10, 2, 1) = -8.0F;     // both move FP 2
  component(rig.expression, 1, 2, 1) = 4.0F;   // .75 * -8 + .25 * 4 = -5
  component(rig.expression, 1, 2, 0) = 2.0F;   // an axis of one alone is shared too: .25 * 2 = .5
  component(rig.viseme, 10, 3, 0) = 1.5F;      // only the viseme moves FP 3
  component(rig.expression, 1, 40, 2) = 2.5F;  // only the expression moves FP 40
  semblante_frame frame{};
  frame.viseme1 = 10, frame.viseme_blend = 63, frame.expression1 = 1, frame.intensity1 = 63;
  const semblante_pose pose = rig.pose(frame);
  EXPECT_EQ(pose.fp[2 * 3 + 1], -5.0F);
  EXPECT_EQ(pose.fp[2 * 3], 0.5F);
  EXPECT_EQ(pose.fp[3 * 3], 1.5F);
  EXPECT_EQ(pose.fp[40 * 3 + 2], 2.5F);
}

TEST(Kernel_Fap1, BlendsTwoVisemesBy63rds) {
  TestRig rig;
  component(rig.viseme, 4, 7, 1) = 9.0F;
  component(rig.viseme, 5, 7, 1) = 3.0F;
  semblante_frame frame{};
  frame.viseme1 = 4, frame.viseme2 = 5, frame.viseme_blend = 21;
  // 21/63 * 9 + 42/63 * 3 = 3 + 2
  EXPECT_NEAR(rig.pose(frame).fp[7 * 3 + 1], 5.0F, 1e-6F);
  frame.viseme_blend = 200;  // beyond 63 counts as 63
  EXPECT_EQ(rig.pose(frame).fp[7 * 3 + 1], 9.0F);
}

TEST(Kernel_Fap2, AddsTwoExpressionsByTheirIntensities) {
  TestRig rig;
  component(rig.expression, 3, 7, 1) = 9.0F;
  component(rig.expression, 6, 7, 1) = 63.0F;
  semblante_frame frame{};
  frame.expression1 = 3, frame.intensity1 = 21, frame.expression2 = 6, frame.intensity2 = 1;
  // 21/63 * 9 + 1/63 * 63 = 3 + 1
  EXPECT_NEAR(rig.pose(frame).fp[7 * 3 + 1], 4.0F, 1e-6F);
}

TEST(Kernel_HighLevel, MovesNothing_WhenTheEntryDoesNotExistOrTheTableIsMissing) {
  TestRig rig;
  component(rig.viseme, 14, 7, 1) = 1.0F;
  component(rig.expression, 6, 7, 1) = 1.0F;
  semblante_frame frame{};
  frame.viseme1 = 15, frame.viseme2 = 255, frame.viseme_blend = 31;
  frame.expression1 = 7, frame.intensity1 = 63;
  for (const float d : rig.pose(frame).fp) EXPECT_EQ(d, 0.0F);
  frame = {};
  frame.viseme1 = 14, frame.viseme_blend = 63, frame.expression1 = 6, frame.intensity1 = 63;
  rig.rig.viseme = rig.rig.expression = nullptr;
  for (const float d : rig.pose(frame).fp) EXPECT_EQ(d, 0.0F);
}

TEST(Kernel_Eq6, MovesThePointOfEveryTranslationFapAlongItsAxis) {
  TestRig rig;
  for (std::size_t n = 3; n <= 68; ++n) {
    const mpeg4::Fap& fap = mpeg4::fap(n);
    if (fap.kind != mpeg4::FapKind::translation || n == 27 || n == 28) continue;
    semblante_frame frame{};
    frame.fap[n] = 10.0F;
    const semblante_pose pose = rig.pose(frame);
    const std::size_t moved = fap.feature_points[0] * 3U + static_cast<std::size_t>(fap.axis);
    for (std::size_t i = 0; i < 84 * 3; ++i) {
      const float expected = i == moved ? fap.sign * 10.0F * rig.rig.fapu[static_cast<int>(fap.unit)] : 0.0F;
      EXPECT_EQ(pose.fp[i], expected) << fap.name;
    }
  }
}

TEST(Kernel_Eq6, ReplacesTheHighLevelOnItsOwnAxisOnly) {
  TestRig rig;
  component(rig.viseme, 10, 0, 1) = -7.0F;  // 2.1
  component(rig.viseme, 10, 0, 2) = -3.0F;
  semblante_frame frame{};
  frame.viseme1 = 10, frame.viseme_blend = 63;
  frame.fap[3] = 2.0F;  // open_jaw: -2 * MNS = -16
  const semblante_pose pose = rig.pose(frame);
  EXPECT_EQ(pose.fp[1], -16.0F);
  EXPECT_EQ(pose.fp[2], -3.0F);
}

TEST(Kernel_Eq6, DoesNothing_WhenTheUnitIsUnknown) {
  TestRig rig;
  component(rig.viseme, 10, 0, 1) = -7.0F;
  rig.rig.fapu[3] = 0.0F;
  semblante_frame frame{};
  frame.viseme1 = 10, frame.viseme_blend = 63;
  frame.fap[3] = 2.0F;
  EXPECT_EQ(rig.pose(frame).fp[1], -7.0F);
}

TEST(Kernel_Frame, NumbersWithoutAFapMoveNothing) {
  TestRig rig;
  const semblante_pose neutral = rig.pose({});
  for (const int n : {0, 1, 2}) {
    semblante_frame frame{};
    frame.fap[n] = 100.0F;
    const semblante_pose pose = rig.pose(frame);
    EXPECT_EQ(std::memcmp(&pose, &neutral, sizeof pose), 0) << n;
  }
}

/// One vertex at (x, y, z) with no influencer; `rigid` is one of SEMBLANTE_RIGID_*.
std::vector<float> one_vertex(const TestRig& rig, const semblante_frame& frame, std::vector<float> at,
                              std::uint8_t rigid = 0) {
  const std::uint32_t offsets[2] = {0, 0};
  const semblante_face face = {1, at.data(), offsets, nullptr, nullptr, &rigid, nullptr};
  const semblante_pose pose = rig.pose(frame);
  std::vector<float> out(3);
  semblante_deform(&face, &pose, out.data());
  return out;
}

void expect_near(const std::vector<float>& a, const std::vector<float>& b, float tolerance = 1e-6F) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

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
  frame.fap[49] = quarter_turn;  // head last: (3, 0, 4) -> (4, 0, -3)
  expect_near(one_vertex(rig, frame, {3, 0, 1}, 1), {4, 0, -3});
}

/// FPs by dense index.
constexpr int jaw = 0, lower_lip = 2, chin = 9, upper_lid = 14, lower_lid = 16, fold = 26;

float y_of(const semblante_pose& pose, int fp) { return pose.fp[fp * 3 + 1]; }

TEST(Kernel_Companions, FollowTheirLeader_ExceptOnTheAxisOfAFapOfTheirOwn) {
  TestRig rig;
  const semblante_companion companions[] = {{chin, jaw, 0, 0, 0.5F}, {lower_lip, jaw, 1, 0, 0.25F}};
  rig.rig.companion = companions;
  rig.rig.companion_count = 2;
  semblante_frame frame{};
  frame.fap[3] = 2.0F;   // 2.1 down by 16
  frame.fap[14] = 1.0F;  // and forward by 8
  semblante_pose pose = rig.pose(frame);
  EXPECT_EQ(y_of(pose, chin), -8.0F);
  EXPECT_EQ(pose.fp[chin * 3 + 2], 4.0F);
  EXPECT_EQ(y_of(pose, lower_lip), 0.0F) << "by the standard, FAP 3 does not part the lips";
  rig.rig.lip_share = 1.0F;
  EXPECT_EQ(y_of(rig.pose(frame), lower_lip), -4.0F);
  frame.fap[18] = 0.125F;  // 2.10 up by 1: wins, on its axis alone
  pose = rig.pose(frame);
  EXPECT_EQ(y_of(pose, chin), 1.0F);
  EXPECT_EQ(pose.fp[chin * 3 + 2], 4.0F);
}

TEST(Kernel_Companions, OfASetThatMovesThem_FollowOnlyWhatFapsAdd) {
  TestRig rig;
  const semblante_companion companions[] = {{chin, jaw, 0, 0, 0.5F}, {fold, jaw, 0, 0, 0.5F}};
  rig.rig.companion = companions;
  rig.rig.companion_count = 2;
  component(rig.viseme, 1, jaw, 1) = -8.0F;
  component(rig.viseme, 1, chin, 1) = -1.0F;
  semblante_frame frame{};
  frame.viseme1 = 1;
  frame.viseme_blend = 63;
  EXPECT_EQ(y_of(rig.pose(frame), chin), -1.0F);
  EXPECT_EQ(y_of(rig.pose(frame), fold), -4.0F) << "the set does not move it";
  frame.fap[3] = 2.0F;  // the jaw from -8 to -16
  EXPECT_EQ(y_of(rig.pose(frame), chin), -5.0F);
  EXPECT_EQ(y_of(rig.pose(frame), fold), -8.0F);
}

/// Lids of the left eye: the pivot at the origin, the slit half a radian and 4 high.
TestRig& with_lids(TestRig& rig) {
  rig.rig.lids[0] = {{0, 0, 1}, 0.5F, 4.0F, {0.5F, 0.25F}, {}};
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
  frame.fap[21] = 6.0F;  // both three quarters: they meet half way and do not cross
  expect_near(on_lid(rig, frame, on_circle(0.0F, 3.0), upper_lid), on_circle(0.0F, 1.0), 1e-5F);
  expect_near(on_lid(rig, frame, on_circle(0.0F, -1.0), lower_lid), on_circle(0.0F, 1.0), 1e-5F);
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

TEST(Kernel_Eq7, SumsTheRow) {
  TestRig rig;
  const float rest[] = {0, 0, 0, 1, 1, 1};
  const std::uint32_t offsets[] = {0, 2, 2};
  const std::uint8_t points[] = {0, 5};
  const float weights[] = {0.25F, 0.75F};
  const semblante_face face = {2, rest, offsets, points, weights, nullptr, nullptr};
  semblante_pose pose = rig.pose({});
  pose.fp[1] = -8.0F;     // FP 0: (0, -8, 0)
  pose.fp[5 * 3] = 4.0F;  // FP 5: (4, 0, 0)
  float out[6];
  semblante_deform(&face, &pose, out);
  expect_near({out[0], out[1], out[2]}, {3, -2, 0}, 0.0F);  // .25 * (0,-8,0) + .75 * (4,0,0)
  expect_near({out[3], out[4], out[5]}, {1, 1, 1}, 0.0F);   // an empty row stays
}

/// A random face, rig and frame, from a seed.
struct RandomCase {
  TestRig rig;
  std::vector<float> rest;
  std::vector<std::uint32_t> offsets{0};
  std::vector<std::uint8_t> points;
  std::vector<float> weights;
  std::vector<std::uint8_t> rigid;
  semblante_face face{};
  std::mt19937 random;

  explicit RandomCase(unsigned seed) : random(seed) {
    std::uniform_real_distribution<float> unit(-1, 1);
    for (auto* table : {&rig.viseme, &rig.expression}) {
      for (std::size_t i = 84 * 3; i < table->size(); i += 3) {  // entry 0 of both is rest
        if (random() % 3 == 0) {
          for (std::size_t k = 0; k < 3; ++k) (*table)[i + k] = unit(random);
        }
      }
    }
    for (float& f : rig.rig.fapu) f = 0.002F + 0.001F * unit(random);
    rig.rig.viseme_share = 0.85F;
    for (float& p : rig.rig.head_pivot) p = 3 * unit(random);
    for (auto& pivot : rig.rig.eye_pivot) {
      for (float& p : pivot) p = unit(random);
    }
    for (auto& iris : rig.rig.iris) {
      iris = {{unit(random), unit(random), unit(random)}, 1.0F + 0.5F * unit(random), 4.0F + unit(random), 0};
      const float length =
          std::sqrt(iris.axis[0] * iris.axis[0] + iris.axis[1] * iris.axis[1] + iris.axis[2] * iris.axis[2]);
      for (float& a : iris.axis) a /= length;
      iris.bend = 0.1F * unit(random);
    }
    const float tilt = unit(random);
    rig.rig.tongue = {{unit(random), unit(random), unit(random)},
                      {std::cos(tilt), 0, -std::sin(tilt)},
                      {0, 1, 0},
                      2.0F + unit(random),
                      1.0F + 0.5F * unit(random)};
    const std::uint32_t count = 200;
    for (std::uint32_t v = 0; v < count; ++v) {
      for (int i = 0; i < 3; ++i) rest.push_back(5 * unit(random));
      const unsigned part = random() % 7;  // none, eyes, irises, all of the tongue, some share of it
      rigid.push_back(static_cast<std::uint8_t>(part < 5 ? part : part == 5 ? 255 : 128 + random() % 128));
      const unsigned entries = random() % 8;
      float sum = 0;
      for (unsigned e = 0; e < entries; ++e) {
        points.push_back(static_cast<std::uint8_t>(random() % 84));
        weights.push_back(0.1F + std::abs(unit(random)));
        sum += weights.back();
      }
      for (unsigned e = 0; e < entries; ++e) weights[weights.size() - 1 - e] /= sum;
      offsets.push_back(static_cast<std::uint32_t>(points.size()));
    }
    face = {count, rest.data(), offsets.data(), points.data(), weights.data(), rigid.data(), nullptr};
  }

  semblante_frame frame() {
    std::uniform_real_distribution<float> unit(-1, 1);
    semblante_frame f{};
    f.viseme1 = static_cast<std::uint8_t>(random() % 15);
    f.viseme2 = static_cast<std::uint8_t>(random() % 15);
    f.viseme_blend = static_cast<std::uint8_t>(random() % 64);
    f.expression1 = static_cast<std::uint8_t>(random() % 7);
    f.intensity1 = static_cast<std::uint8_t>(random() % 64);
    f.expression2 = static_cast<std::uint8_t>(random() % 7);
    f.intensity2 = static_cast<std::uint8_t>(random() % 64);
    for (std::size_t n = 3; n <= 68; ++n) {
      if (random() % 4 == 0) f.fap[n] = unit(random) * static_cast<float>(mpeg4::fap(n).usual_max);
      if (n == 29 || n == 30) f.fap[n] *= 2.0F;  // far enough to show; some beyond what a pupil can
    }
    return f;
  }
};

TEST(Kernel_Oracle, AgreesOnRandomFacesAndFrames) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    RandomCase test(seed);
    for (int i = 0; i < 5; ++i) {
      const semblante_frame frame = test.frame();
      const semblante_pose pose = test.rig.pose(frame);
      std::vector<float> positions(test.rest.size());
      semblante_deform(&test.face, &pose, positions.data());
      const oracle::Pose literal = oracle::evaluate(test.rig.rig, frame);
      for (std::size_t fp = 0; fp < 84; ++fp) {
        for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(pose.fp[fp * 3 + k], literal.fp[fp][k], 1e-6) << seed;
      }
      const auto expected = oracle::deform(test.face, test.rig.rig, literal);
      for (std::size_t v = 0; v < expected.size(); ++v) {
        for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(positions[v * 3 + k], expected[v][k], 1e-5) << seed << " " << v;
      }
    }
  }
}

TEST(Kernel_Deform, GivesTheRestPositionsExactly_ForTheNeutralPose) {
  RandomCase test(7);
  const semblante_pose pose = test.rig.pose({});
  std::vector<float> positions(test.rest.size());
  semblante_deform(&test.face, &pose, positions.data());
  EXPECT_EQ(positions, test.rest);
}

TEST(Kernel_Interpolate, GivesItsEndsExactly_AndClampsBeyond) {
  RandomCase test(3);
  const semblante_pose a = test.rig.pose(test.frame());
  const semblante_pose b = test.rig.pose(test.frame());
  for (const auto& [t, end] : {std::pair{0.0F, &a}, {-1.0F, &a}, {std::nanf(""), &a}, {1.0F, &b}, {2.0F, &b}}) {
    semblante_pose out;
    semblante_interpolate(&a, &b, t, &out);
    EXPECT_EQ(std::memcmp(&out, end, sizeof out), 0) << t;
  }
}

TEST(Kernel_Interpolate, MovesEveryVertexLinearly_WhenNothingTurns) {
  RandomCase test(4);
  semblante_frame frames[2] = {test.frame(), test.frame()};
  for (auto& frame : frames) {
    for (const int n : {23, 24, 25, 26, 29, 30, 47, 48, 49, 50}) frame.fap[n] = 0;
  }
  const semblante_pose a = test.rig.pose(frames[0]);
  const semblante_pose b = test.rig.pose(frames[1]);
  semblante_pose mid;
  semblante_interpolate(&a, &b, 0.25F, &mid);
  std::vector<float> pa(test.rest.size());
  std::vector<float> pb(test.rest.size());
  std::vector<float> pm(test.rest.size());
  semblante_deform(&test.face, &a, pa.data());
  semblante_deform(&test.face, &b, pb.data());
  semblante_deform(&test.face, &mid, pm.data());
  for (std::size_t i = 0; i < pm.size(); ++i) ASSERT_NEAR(pm[i], 0.75F * pa[i] + 0.25F * pb[i], 2e-6F);
}

TEST(Kernel_Interpolate, LargeTurns_StayOnTheArc_AndNearEvenSpeed) {
  // Even speed would be t of the angle. Normalized linear interpolation is at most so far off (degrees), worst a fifth
  // of the way from either end: 2 atan2(t sin h, 1 - t + t cos h) - 2 h t with h half the step.
  for (const auto& [step, bound] : {std::pair{10.0, 0.002}, {30.0, 0.04}, {60.0, 0.3}, {90.0, 0.95}}) {
    TestRig rig;
    semblante_frame frame{};
    frame.fap[49] = static_cast<float>(step * std::numbers::pi / 180 * 1e5);
    const semblante_pose a = rig.pose({});
    const semblante_pose b = rig.pose(frame);
    double before = 0;
    double worst = 0;
    for (int i = 1; i < 100; ++i) {
      const float t = static_cast<float>(i) / 100;
      semblante_pose pose;
      semblante_interpolate(&a, &b, t, &pose);
      EXPECT_NEAR(pose.head_rotation[0], 0, 1e-6);
      EXPECT_NEAR(pose.head_rotation[2], 0, 1e-6);
      const double angle = 2 * std::atan2(pose.head_rotation[1], pose.head_rotation[3]) * 180 / std::numbers::pi;
      EXPECT_GT(angle, before);
      worst = std::max(worst, std::abs(angle - t * step));
      before = angle;
    }
    EXPECT_LT(worst, bound) << step;
    EXPECT_GT(worst, bound / 4) << "the bound says something, " << step;
  }
}

TEST(Kernel_Interpolate, TurnsTheShorterWay_AndMayWriteOverItsInput) {
  TestRig rig;
  semblante_frame frame{};
  frame.fap[49] = 60000.0F;
  semblante_pose a = rig.pose({});
  semblante_pose b = rig.pose(frame);
  for (float& q : b.head_rotation) q = -q;  // the same rotation, the other sign
  semblante_interpolate(&a, &b, 0.5F, &a);
  // Half of 0.6 rad is 0.3; the quaternion holds the sine and cosine of half of that.
  EXPECT_NEAR(a.head_rotation[1], std::sin(0.15), 1e-6);
  EXPECT_NEAR(a.head_rotation[3], std::cos(0.15), 1e-6);
}

}  // namespace

// From a frame to a pose, against cases computed by hand.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "core/kernel/semblante_kernel.h"
#include "core/tables/mpeg4.h"
#include "tests/unit/kernel/kernel_rig.h"

extern "C" unsigned semblante_frame_bytes_in_c(void);

namespace semblante::testing {
namespace {

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

TEST(Kernel_Companions, OfALeaderThatFollows_FollowItThere) {
  TestRig rig;
  const semblante_companion companions[] = {
      {chin, fold, 0, 0, 0.5F}, {fold, jaw, 0, 0, 0.75F}, {fold, jaw, 1, 0, 4.0F}};
  rig.rig.companion = companions;
  rig.rig.companion_count = 3;
  semblante_frame frame{};
  frame.fap[3] = 2.0F;  // the jaw down by 16
  EXPECT_EQ(y_of(rig.pose(frame), fold), -12.0F);
  EXPECT_EQ(y_of(rig.pose(frame), chin), -6.0F);
  rig.rig.lip_share = 1.0F;
  EXPECT_EQ(y_of(rig.pose(frame), fold), -76.0F);
  EXPECT_EQ(y_of(rig.pose(frame), chin), -6.0F) << "a leader leads without what it follows by choice";
}

}  // namespace
}  // namespace semblante::testing

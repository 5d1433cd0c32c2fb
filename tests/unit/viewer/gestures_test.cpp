#include "clients/native/viewer/gestures.h"

#include <gtest/gtest.h>

namespace semblante::testing {
namespace {

using viewer::Gestures;

TEST(Gestures, DragOfOneFinger_Turns_AndStartsAtTheFinger) {
  Gestures gestures;
  gestures.touch({{{0.5F, 0.5F}, {}}}, 1, 0);
  EXPECT_EQ(gestures.take().turn_x, 0);
  gestures.touch({{{0.6F, 0.5F}, {}}}, 1, 0.1);
  gestures.touch({{{0.8F, 0.25F}, {}}}, 1, 0.2);
  const auto did = gestures.take();
  EXPECT_NEAR(did.turn_x, 0.3F, 1e-6F);
  EXPECT_NEAR(did.turn_y, -0.25F, 1e-6F);
  EXPECT_EQ(did.zoom, 1);
  EXPECT_EQ(gestures.take().turn_x, 0);  // told once
}

TEST(Gestures, TwoFingersApart_ComeNearer_AndTheOneThatStaysDoesNotJump) {
  Gestures gestures;
  gestures.touch({{{0.4F, 0.5F}, {}}}, 1, 0);
  gestures.touch({{{0.4F, 0.5F}, {0.6F, 0.5F}}}, 2, 0.1);
  gestures.touch({{{0.3F, 0.5F}, {0.7F, 0.5F}}}, 2, 0.2);
  gestures.touch({{{0.7F, 0.5F}, {}}}, 1, 0.3);
  gestures.touch({}, 0, 0.35);
  const auto did = gestures.take();
  EXPECT_NEAR(did.zoom, 0.5F, 1e-5F);
  EXPECT_EQ(did.turn_x, 0);
  EXPECT_FALSE(did.looks_front);
}

TEST(Gestures, FingersAtOnePoint_ZoomByAFiniteFactor) {
  Gestures gestures;
  gestures.touch({{{0.5F, 0.5F}, {0.5F, 0.5F}}}, 2, 0);
  gestures.touch({{{0.4F, 0.5F}, {0.6F, 0.5F}}}, 2, 0.1);
  EXPECT_NEAR(gestures.take().zoom, 0.1F, 1e-5F);
}

/// A finger that comes at `x` and goes after `seconds`, at `to`.
void tap(Gestures& gestures, double begin, double seconds = 0.05, float x = 0.5F, float to = 0.5F) {
  gestures.touch({{{x, 0.5F}, {}}}, 1, begin);
  gestures.touch({{{to, 0.5F}, {}}}, 1, begin + seconds / 2);
  gestures.touch({}, 0, begin + seconds);
}

TEST(Gestures, TwoTaps_LookAtTheFront) {
  Gestures gestures;
  tap(gestures, 0);
  EXPECT_FALSE(gestures.take().looks_front);
  tap(gestures, 0.2);
  EXPECT_TRUE(gestures.take().looks_front);
  tap(gestures, 0.4);  // begins another pair
  EXPECT_FALSE(gestures.take().looks_front);
}

TEST(Gestures, SlowTaps_AndADragBetween_DoNot) {
  Gestures gestures;
  tap(gestures, 0);
  tap(gestures, 1);
  EXPECT_FALSE(gestures.take().looks_front);
  tap(gestures, 2);
  tap(gestures, 2.1, 0.05, 0.5F, 0.7F);
  EXPECT_FALSE(gestures.take().looks_front);
  tap(gestures, 3);
  tap(gestures, 3.2, 0.6);
  EXPECT_FALSE(gestures.take().looks_front);
}

}  // namespace
}  // namespace semblante::testing

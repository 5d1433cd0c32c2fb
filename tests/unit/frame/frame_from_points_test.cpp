// Feature points decide how a head stands: every head, in all 24 positions.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "tests/unit/frame/turned_heads.h"

namespace semblante::test {
namespace {

/// A point or two of each region: what somebody in a hurry marks.
bool is_quick(FeaturePointId id) {
  static const std::set<std::string> quick = {"2.1", "2.2",  "2.3",  "2.4", "2.5", "3.1", "3.2", "3.3", "3.4",  "3.7",
                                              "3.8", "3.11", "3.12", "4.3", "4.4", "8.3", "8.4", "9.3", "9.15", "5.1"};
  return quick.count(to_string(id)) == 1;
}

TEST(FrameFromPoints, AllHeads_InAll24Positions_AreRecovered) {
  for (const Head& upright : upright_heads()) {
    if (upright.points.empty()) continue;
    for (const Axes& axes : all_axes()) {
      auto points = turned(upright.points, axes);
      const ModelFrame all = guess_frame(points, {});
      EXPECT_TRUE(all.axes_sure) << upright.name;
      EXPECT_EQ(all.axes, axes) << upright.name << " " << to_string(axes.up) << to_string(axes.front);
      std::erase_if(points, [](const PlacedPoint& p) { return !is_quick(p.id); });
      const ModelFrame quick = guess_frame(points, {});
      EXPECT_TRUE(quick.axes_sure) << upright.name;
      EXPECT_EQ(quick.axes, axes) << upright.name << " quick set";
    }
  }
}

TEST(FrameFromPoints, UnitsOfTheHeads_AreThoseTheyWereMadeIn) {
  for (const Head& head : upright_heads()) {
    if (head.points.empty()) continue;
    const ModelFrame guess = guess_frame(head.points, {});
    EXPECT_TRUE(guess.unit_sure) << head.name;
    const LengthUnit expected = head.name == "sample"          ? LengthUnit::metre
                                : head.name == "makehuman obj" ? LengthUnit::decimetre
                                                               : LengthUnit::centimetre;
    EXPECT_EQ(guess.unit, expected) << head.name;
  }
}

TEST(FrameFromPoints, EyesThatFitOnlyInches_AreNotSure) {
  Head head = upright_heads().front();
  for (PlacedPoint& point : head.points) point.position /= metres_per(LengthUnit::inch);
  const ModelFrame guess = guess_frame(head.points, {});
  EXPECT_EQ(guess.unit, LengthUnit::inch);
  EXPECT_FALSE(guess.unit_sure);
  EXPECT_TRUE(guess.axes_sure);
  EXPECT_NE(guess.reasons.back().find("not certain"), std::string::npos) << guess.reasons.back();
}

TEST(FrameFromPoints, LeftAndRightExchanged_IsSaid_AndDoesNotTurnTheHeadRound) {
  Head head = upright_heads().front();
  for (PlacedPoint& point : head.points) point.position.x = -point.position.x;
  const ModelFrame guess = guess_frame(head.points, {});
  EXPECT_TRUE(guess.axes_sure);
  EXPECT_EQ(guess.axes, Axes{});
  EXPECT_NE(guess.reasons.front().find("left and right"), std::string::npos);
}

TEST(FrameFromPoints, TooFewPoints_LeaveTheGuessAsItWas) {
  const Head head = upright_heads().front();
  ModelFrame before;
  before.axes = {Direction::plus_z, Direction::minus_y};
  before.unit = LengthUnit::inch;
  before.reasons = {"seen before"};
  EXPECT_EQ(guess_frame(std::span<const PlacedPoint>{}, before).axes, before.axes);
  for (const char* const only : {"9.3", "2.1"}) {
    std::vector<PlacedPoint> few;
    for (const PlacedPoint& point : head.points) {
      if (to_string(point.id) == only) few.push_back(point);
    }
    const ModelFrame guess = guess_frame(few, before);
    EXPECT_EQ(guess.axes, before.axes);
    EXPECT_FALSE(guess.axes_sure);
    EXPECT_EQ(guess.unit, LengthUnit::inch);
    EXPECT_EQ(guess.reasons, before.reasons);
  }
}

TEST(FrameFromPoints, WithoutNoseOrEars_SidesAlone_TurnNothing) {
  Head head = upright_heads().front();
  std::erase_if(head.points, [](const PlacedPoint& p) {
    const std::string id = to_string(p.id);
    return id != "3.7" && id != "3.12" && id != "2.1" && id != "2.4" && id != "2.5";
  });
  EXPECT_TRUE(guess_frame(head.points, {}).axes_sure);
  for (PlacedPoint& point : head.points) point.position.x = -point.position.x;
  const ModelFrame exchanged = guess_frame(head.points, {});
  EXPECT_FALSE(exchanged.axes_sure);
  EXPECT_EQ(exchanged.axes, Axes{});
}

TEST(FrameFromPoints, AHeadTiltedByHalfARightAngle_IsSureOnlyByTheProportionsOfAFace) {
  Head head = upright_heads().front();
  std::vector<PlacedPoint> few;
  for (PlacedPoint& p : head.points) {
    const double y = p.position.y;
    p.position.y = (y - p.position.z) * 0.7071;
    p.position.z = (y + p.position.z) * 0.7071;
    static const std::set<std::string> shown = {"2.10", "3.5", "3.6", "4.1", "4.2", "8.1", "9.3"};
    if (shown.count(to_string(p.id)) == 1) few.push_back(p);
  }
  const Axes forward{Direction::plus_z, Direction::minus_y};
  const ModelFrame unsure = guess_frame(few, {});
  EXPECT_FALSE(unsure.axes_sure);
  EXPECT_TRUE(unsure.axes == Axes{} || unsure.axes == forward);
  const ModelFrame sure = guess_frame(head.points, {});
  EXPECT_TRUE(sure.axes_sure);
  EXPECT_TRUE(sure.axes == Axes{} || sure.axes == forward);
  const glm::dvec3 up = turn_upright(sure) * glm::dvec3(0.0, 0.7071, 0.7071);
  EXPECT_GT(up.y, 0.98) << "the axis that was up before";
}

}  // namespace
}  // namespace semblante::test

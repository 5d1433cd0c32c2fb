#include "core/performance/performance.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/performance/easing.h"

namespace semblante {
namespace {

constexpr float per_degree = 1745.3293F;

Cue cue(double time, double duration, CueTarget target, double value = 1.0) {
  Cue made;
  made.time = time;
  made.duration = duration;
  made.target = target;
  made.value = value;
  made.easing.kind = EasingKind::linear;
  return made;
}

Cue with(Cue made, double attack, double release) {
  made.attack = attack;
  made.release = release;
  return made;
}

Cue keyed(double time, CueTarget target, std::vector<CueKey> keys) {
  Cue made;
  made.time = time;
  made.target = target;
  made.keys = std::move(keys);
  made.easing.kind = EasingKind::linear;
  return made;
}

Performance compiled(std::vector<Cue> cues, std::optional<IdleLife> idle = std::nullopt) {
  auto made = Performance::compile({"", std::nullopt, idle, std::move(cues)});
  EXPECT_TRUE(made) << (made ? "" : made.error().where + ": " + made.error().message);
  return made ? std::move(*made) : *Performance::compile({"", 1.0, std::nullopt, {}});
}

Error refused(std::vector<Cue> cues) {
  const auto made = Performance::compile({"", std::nullopt, std::nullopt, std::move(cues)});
  EXPECT_FALSE(made);
  return made ? Error{} : made.error();
}

TEST(Easing, Curves_GoFromNothingToAll) {
  for (const auto kind : {EasingKind::linear, EasingKind::ease_in, EasingKind::ease_out, EasingKind::ease_in_out}) {
    const Easing easing{kind};
    EXPECT_EQ(ease(easing, 0.0), 0.0);
    EXPECT_EQ(ease(easing, 1.0), 1.0);
    for (double x = 0.0; x < 1.0; x += 0.01) EXPECT_LT(ease(easing, x), ease(easing, x + 0.01));
  }
  EXPECT_EQ(ease({EasingKind::step}, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(ease({EasingKind::ease_in}, 0.5), 0.25);
  EXPECT_DOUBLE_EQ(ease({EasingKind::ease_out}, 0.5), 0.75);
}

TEST(Easing, Bezier_IsTheCurveOfItsPoints) {
  // s = 0.5 of the curve over (0.25, 0.1), (0.25, 1): x = (3 * 0.25 + 3 * 0.25 + 1) / 8, y likewise.
  EXPECT_NEAR(ease({EasingKind::bezier, 0.25, 0.1, 0.25, 1.0}, 0.3125), 0.5375, 1e-9);
  // Control points on the diagonal: a straight line.
  EXPECT_NEAR(ease({EasingKind::bezier, 0.2, 0.2, 0.7, 0.7}, 0.42), 0.42, 1e-9);
  EXPECT_GT(ease({EasingKind::bezier, 0.3, 0.0, 0.5, 1.8}, 0.8), 1.0) << "it may overshoot";
}

TEST(Performance_Fap, RisesStaysFalls) {
  const auto made = compiled({with(cue(100, 400, FapTarget{3}, 200), 100, 200)});
  EXPECT_EQ(made.frame_at(99).fap[3], 0.0F);
  EXPECT_FLOAT_EQ(made.frame_at(150).fap[3], 100.0F);
  EXPECT_FLOAT_EQ(made.frame_at(250).fap[3], 200.0F);
  EXPECT_FLOAT_EQ(made.frame_at(400).fap[3], 100.0F);
  EXPECT_EQ(made.frame_at(500).fap[3], 0.0F);
  EXPECT_EQ(made.duration(), 500.0);
}

TEST(Performance_Fap, NeighboursCrossFadeWithoutPassingThroughRest) {
  const auto made =
      compiled({with(cue(0, 200, FapTarget{3}, 100), 50, 50), with(cue(200, 200, FapTarget{3}, 300), 50, 50)});
  EXPECT_FLOAT_EQ(made.frame_at(190).fap[3], 100.0F) << "held until the next one has arrived";
  EXPECT_FLOAT_EQ(made.frame_at(225).fap[3], 200.0F);
  EXPECT_FLOAT_EQ(made.frame_at(250).fap[3], 300.0F);
}

TEST(Performance_Fap, ApartEachReturnsToRest) {
  const auto made =
      compiled({with(cue(0, 200, FapTarget{3}, 100), 50, 50), with(cue(201, 200, FapTarget{3}, 300), 50, 50)});
  EXPECT_NEAR(made.frame_at(199).fap[3], 2.0F, 1e-4);
}

TEST(Performance_Fap, ShortOneWithinALongOneIsLaidOverIt) {
  const auto made =
      compiled({with(cue(0, 1000, FapTarget{3}, 100), 0, 0), with(cue(400, 200, FapTarget{3}, 500), 100, 100)});
  EXPECT_FLOAT_EQ(made.frame_at(300).fap[3], 100.0F);
  EXPECT_FLOAT_EQ(made.frame_at(450).fap[3], 300.0F);
  EXPECT_FLOAT_EQ(made.frame_at(500).fap[3], 500.0F);
  EXPECT_FLOAT_EQ(made.frame_at(700).fap[3], 100.0F);
}

TEST(Performance_Fap, KeysAreJoinedByTheEasing) {
  auto linear = keyed(1000, FapTarget{48}, {{0, 0}, {100, 500}, {300, -500}});
  auto step = linear;
  step.easing.kind = EasingKind::step;
  EXPECT_FLOAT_EQ(compiled({linear}).frame_at(1050).fap[48], 250.0F);
  EXPECT_FLOAT_EQ(compiled({linear}).frame_at(1200).fap[48], 0.0F);
  EXPECT_FLOAT_EQ(compiled({step}).frame_at(1299).fap[48], 500.0F);
  EXPECT_EQ(compiled({linear}).duration(), 1300.0);
}

TEST(Performance_Viseme, NeighboursShareFap1) {
  const auto made =
      compiled({with(cue(0, 120, VisemeTarget{10, 0}), 60, 60), with(cue(120, 120, VisemeTarget{14, 0}), 60, 60)});
  auto frame = made.frame_at(30);
  EXPECT_EQ(frame.viseme1, 10);
  EXPECT_EQ(frame.viseme2, 0);
  EXPECT_EQ(frame.viseme_blend, 32) << "half way, rounded up";
  frame = made.frame_at(135);
  EXPECT_EQ(frame.viseme1, 10);
  EXPECT_EQ(frame.viseme2, 14);
  EXPECT_EQ(frame.viseme_blend, 47) << "a quarter of the way from one to the other";
  frame = made.frame_at(210);
  EXPECT_EQ(frame.viseme1, 14);
  EXPECT_EQ(frame.viseme2, 0);
  EXPECT_EQ(frame.viseme_blend, 32);
}

TEST(Performance_Viseme, ThreeAtOnce_TheTwoStrongestRemain) {
  // Silence 0.1, then 10 with 0.3, then 14 with 0.6.
  const auto hold = [](Cue made) { return with(made, 0, 0); };
  const auto made =
      compiled({hold(cue(0, 100, VisemeTarget{10, 0}, 1.0)), hold(cue(0, 100, VisemeTarget{14, 10}, 0.6))});
  const auto pair = made.frame_at(50);
  EXPECT_EQ(pair.viseme1, 14) << "one cue that covers all is taken as it stands";
  EXPECT_EQ(pair.viseme2, 10);
  EXPECT_EQ(pair.viseme_blend, 38);
  // The second comes in over the first, which is itself mixed with silence: 0.4 * (0.75, 0.25) and 0.6.
  auto weak = hold(cue(0, 1000, VisemeTarget{10, 0}, 0.75));
  auto next = with(cue(0, 1000, VisemeTarget{14, 0}, 1.0), 1000, 0);
  const auto three = compiled({weak, next}).frame_at(600);
  EXPECT_EQ(three.viseme1, 14);
  EXPECT_EQ(three.viseme2, 10);
  EXPECT_EQ(three.viseme_blend, std::lround(63 * 0.6 / 0.9));
}

TEST(Performance_Expression, TwoStrongestOfThree) {
  const auto hold = [](Cue made) { return with(made, 0, 0); };
  const auto frame = compiled({hold(cue(0, 100, ExpressionTarget{1}, 0.2)), hold(cue(0, 100, ExpressionTarget{6}, 0.9)),
                               hold(cue(0, 100, ExpressionTarget{3}, 0.5))})
                         .frame_at(50);
  EXPECT_EQ(frame.expression1, 6);
  EXPECT_EQ(frame.intensity1, 57);
  EXPECT_EQ(frame.expression2, 3);
  EXPECT_EQ(frame.intensity2, 32);
}

TEST(Performance_Blink, ClosesFromWhereTheLidIs) {
  Cue blink;
  blink.time = 1000;
  blink.target = BlinkTarget{true, false};
  const auto made = compiled({with(cue(0, 2000, FapTarget{19}, 300), 0, 0), blink});
  EXPECT_FLOAT_EQ(made.frame_at(999).fap[19], 300.0F);
  EXPECT_FLOAT_EQ(made.frame_at(1080).fap[19], 940.0F) << "shut after 80 ms";
  EXPECT_FLOAT_EQ(made.frame_at(1080).fap[21], 84.0F);
  EXPECT_EQ(made.frame_at(1080).fap[20], 0.0F) << "the other eye stays open";
  EXPECT_FLOAT_EQ(made.frame_at(1160).fap[19], 620.0F);
  EXPECT_FLOAT_EQ(made.frame_at(1240).fap[19], 300.0F);
}

TEST(Performance_Look, HeadFollowsAndTheEyesHoldTheTarget) {
  LookTarget look;
  look.yaw = 30.0;
  look.head_share = 0.5;
  const auto made = compiled({cue(0, 4000, look)});
  const auto early = made.frame_at(80);
  EXPECT_NEAR(early.fap[23] + early.fap[49], 30.0F * per_degree, 1.0F) << "the gaze is there, the head is not";
  EXPECT_GT(early.fap[23], 20.0F * per_degree);
  const auto late = made.frame_at(2000);
  EXPECT_NEAR(late.fap[23], 15.0F * per_degree, 0.1F);
  EXPECT_NEAR(late.fap[24], 15.0F * per_degree, 0.1F);
  EXPECT_NEAR(late.fap[49], 15.0F * per_degree, 0.1F);
}

TEST(Performance_Look, NearTarget_EyesConverge) {
  LookTarget look;
  look.distance = 5.0;
  look.head_share = 0.0;
  const auto frame = compiled({cue(0, 4000, look)}).frame_at(2000);
  const float half = static_cast<float>(std::atan2(0.5, 5.0) * 1e5);
  EXPECT_NEAR(frame.fap[23], -half, 0.1F) << "the left eye turns to its right";
  EXPECT_NEAR(frame.fap[24], half, 0.1F);
}

TEST(Performance_Look, EyesKeepItAgainstAHeadCue) {
  const auto made =
      compiled({with(cue(0, 2000, LookTarget{10.0, 0.0}), 0, 0), with(cue(0, 2000, HeadTarget{5.0, -8.0, 3.0}), 0, 0)});
  const auto frame = made.frame_at(1000);
  EXPECT_NEAR(frame.fap[23] + frame.fap[49], 10.0F * per_degree, 0.1F);
  EXPECT_NEAR(frame.fap[25] + frame.fap[48], 0.0F, 0.1F);
  EXPECT_NEAR(frame.fap[50], 3.0F * per_degree, 0.1F);
}

TEST(Performance_Look, EyesTurnNoFurtherThanEyesDo) {
  LookTarget look{80.0, -80.0};
  look.head_share = 0.0;
  const auto frame = compiled({cue(0, 2000, look)}).frame_at(1000);
  EXPECT_FLOAT_EQ(frame.fap[23], 45.0F * per_degree);
  EXPECT_FLOAT_EQ(frame.fap[25], -35.0F * per_degree);
}

/// Against a slow second reading of the rule: every cue looked at for every frame.
TEST(Performance_Index, FindsWhatIsActive) {
  std::mt19937 random(5);
  std::vector<Cue> cues;
  double time = 0.0;
  for (int i = 0; i < 3000; ++i) {
    time += static_cast<double>(random() % 40);
    // Sums of powers of two under a weight of 1: an add per cue would be seen, and so is the order.
    auto made = with(cue(time, 1.0 + static_cast<double>(random() % 600), FapTarget{3}, static_cast<double>(i)), 0, 0);
    made.easing.kind = EasingKind::step;
    cues.push_back(made);
  }
  const auto made = compiled(cues);
  for (double t = 0.0; t < time + 700.0; t += 3.0) {
    double expected = 0.0;
    for (const auto& one : cues) {
      if (t >= one.time && t < one.time + *one.duration) expected = one.value;
    }
    ASSERT_EQ(made.frame_at(t).fap[3], static_cast<float>(expected)) << t;
  }
}

TEST(Performance_Refused, SaysWhereAndWhy) {
  const auto nan = std::nan("");
  EXPECT_EQ(refused({cue(100, 10, FapTarget{3}), cue(99, 10, FapTarget{3})}).where, "/cues/1/time");
  EXPECT_EQ(refused({cue(nan, 10, FapTarget{3})}).code, ErrorCode::not_finite);
  EXPECT_EQ(refused({cue(0, -1, FapTarget{3})}).where, "/cues/0/duration");
  EXPECT_EQ(refused({cue(0, 10, FapTarget{3}, nan)}).where, "/cues/0/value");
  EXPECT_EQ(refused({cue(0, 10, FapTarget{2})}).where, "/cues/0/fap");
  EXPECT_EQ(refused({cue(0, 10, FapTarget{69})}).where, "/cues/0/fap");
  EXPECT_EQ(refused({cue(0, 10, FapTarget{3}, 1e9)}).code, ErrorCode::out_of_range);
  EXPECT_EQ(refused({cue(0, 10, ExpressionTarget{1}, 1.1)}).where, "/cues/0/value");
  EXPECT_EQ(refused({cue(0, 10, ExpressionTarget{0})}).where, "/cues/0/expression");
  EXPECT_EQ(refused({cue(0, 10, LookTarget{0.0, nan})}).where, "/cues/0/look_at/pitch");
  EXPECT_EQ(refused({cue(0, 10, LookTarget{0.0, 0.0, 0.5})}).where, "/cues/0/look_at/distance");
  EXPECT_EQ(refused({with(cue(0, 10, FapTarget{3}), 6, 6)}).code, ErrorCode::invalid_argument);
  EXPECT_EQ(refused({keyed(0, FapTarget{3}, {{0, 0}, {5, 1}, {5, 2}})}).where, "/cues/0/keys/2/0");
  EXPECT_EQ(refused({cue(86'400'000, 10, FapTarget{3})}).where, "/cues/0/duration");
  EXPECT_EQ(refused({}).code, ErrorCode::empty);
  EXPECT_EQ(refused(std::vector<Cue>(100'001, cue(0, 10, FapTarget{3}))).where, "/cues");
  const auto crowd = refused(std::vector<Cue>(65, cue(0, 10, FapTarget{3})));
  EXPECT_EQ(crowd.code, ErrorCode::too_large);
  EXPECT_EQ(crowd.where, "/cues/64");
}

}  // namespace
}  // namespace semblante

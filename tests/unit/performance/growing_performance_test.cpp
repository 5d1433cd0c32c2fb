#include "core/performance/growing_performance.h"

#include <algorithm>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

namespace semblante {
namespace {

constexpr double lead = 300.0;
constexpr double step = 7.0;

bool operator==(const semblante_frame& a, const semblante_frame& b) { return std::memcmp(&a, &b, sizeof(a)) == 0; }

/// Cues as those of a speech: short ones of each kind, some before the part itself, some beyond its end.
PerformanceScript random_part(std::mt19937& chance, double length) {
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(chance);
  };
  PerformanceScript part;
  part.idle = IdleLife{.seed = 3};
  for (int i = 0; i < 40; ++i) {
    Cue cue;
    cue.time = between(0.0, lead + length);
    cue.duration = between(60.0, 900.0);
    cue.attack = between(0.0, 0.5) * *cue.duration;
    cue.release = between(0.0, 0.5) * *cue.duration;
    cue.value = between(0.0, 1.0);
    const auto number = static_cast<std::uint8_t>(chance() % 3 + 1);
    switch (chance() % 6) {
      case 0:
        cue.target = VisemeTarget{number, 0};
        break;
      case 1:
        cue.target = ExpressionTarget{number};
        break;
      case 2:
        cue.target = HeadTarget{between(-3.0, 3.0), between(-3.0, 3.0), 0.0};
        break;
      case 3:
        cue.target = LookTarget{between(-9.0, 9.0), between(-9.0, 9.0)};
        break;
      case 4:
        cue.target = BlinkTarget{};
        break;
      default:
        cue.target = FapTarget{static_cast<std::uint8_t>(30 + number)};
        cue.value *= 90.0;
    }
    if (i % 5 == 0) cue.attack = cue.release = std::nullopt;
    part.cues.push_back(std::move(cue));
  }
  std::sort(part.cues.begin(), part.cues.end(), [](const Cue& a, const Cue& b) { return a.time < b.time; });
  return part;
}

/// The parts in one script, each where it began.
class Whole {
 public:
  void add(const PerformanceScript& part, double begin, double part_lead) {
    script_.idle = part.idle;
    for (Cue cue : part.cues) {
      cue.time = std::max(0.0, cue.time + begin - part_lead);
      script_.cues.push_back(std::move(cue));
    }
    std::stable_sort(script_.cues.begin(), script_.cues.end(),
                     [](const Cue& a, const Cue& b) { return a.time < b.time; });
  }
  [[nodiscard]] Performance compiled() const {
    auto script = script_;
    script.duration = max_performance_ms;
    auto made = Performance::compile(script);
    EXPECT_TRUE(made) << made.error().where << made.error().message;
    return *std::move(made);
  }

 private:
  PerformanceScript script_;
};

TEST(GrowingPerformance, PartsThatAreInTime_AreOnePerformance) {
  std::mt19937 chance(5);
  GrowingPerformance growing;
  Whole whole;
  double end = 0.0;
  for (int i = 0; i < 12; ++i) {
    const double length = 1500.0 + 100.0 * i;
    const auto part = random_part(chance, length);
    const auto begin = growing.add(part, i == 0 ? 0.0 : lead, length, end - 2500.0);
    ASSERT_TRUE(begin) << begin.error().where << begin.error().message;
    EXPECT_EQ(*begin, end) << "no gap at the joint";
    whole.add(part, *begin, i == 0 ? 0.0 : lead);
    end += length;
    EXPECT_EQ(growing.duration(), end);
  }
  const auto expected = whole.compiled();
  for (double ms = 0.0; ms < end + 2000.0; ms += step)
    ASSERT_TRUE(growing.frame_at(ms, ms) == expected.frame_at(ms)) << ms;
}

TEST(GrowingPerformance, PartThatIsLate_ChangesNothingThatWasShown) {
  std::mt19937 chance(7);
  for (int round = 0; round < 30; ++round) {
    GrowingPerformance growing;
    Whole whole;
    double shown = 0.0;
    for (int i = 0; i < 4; ++i) {
      const double length = 1200.0;
      const auto part = random_part(chance, length);
      std::vector<semblante_frame> before;
      for (double ms = 0.0; i > 0 && ms <= shown; ms += step) before.push_back(growing.frame_at(ms, ms));
      const double end = growing.duration();
      const auto begin = growing.add(part, i == 0 ? 0.0 : lead, length, shown);
      ASSERT_TRUE(begin);
      EXPECT_GE(*begin, end);
      EXPECT_NEAR(std::remainder(*begin - end, GrowingPerformance::late_step_ms), 0.0, 1e-6);
      whole.add(part, *begin, i == 0 ? 0.0 : lead);
      for (std::size_t k = 0; k < before.size(); ++k) {
        const double ms = static_cast<double>(k) * step;
        ASSERT_TRUE(growing.frame_at(ms, ms) == before[k]) << ms << " of " << shown;
      }
      shown = growing.duration() + std::uniform_real_distribution<double>(-700.0, 1500.0)(chance);
    }
    const auto expected = whole.compiled();
    for (double ms = 0.0; ms < growing.duration(); ms += step)
      ASSERT_TRUE(growing.frame_at(ms, ms) == expected.frame_at(ms)) << "nothing jumps at " << ms;
  }
}

TEST(GrowingPerformance, BeyondTheEnd_TheFaceRestsAndLives) {
  GrowingPerformance growing;
  PerformanceScript part;
  part.idle = IdleLife{};
  Cue smile;
  smile.duration = 900.0;
  smile.target = ExpressionTarget{1};
  part.cues.push_back(smile);
  ASSERT_TRUE(growing.add(part, 0.0, 1000.0, 0.0));
  EXPECT_GT(growing.frame_at(500.0, 500.0).intensity1, 0);
  EXPECT_EQ(growing.frame_at(2000.0, 2000.0).intensity1, 0);
  EXPECT_FALSE(growing.frame_at(2000.0, 2000.0) == growing.frame_at(3000.0, 3000.0)) << "the head goes on to drift";
  part.cues[0].target = ExpressionTarget{9};
  EXPECT_FALSE(growing.add(part, 0.0, 1000.0, 0.0));
  EXPECT_EQ(growing.duration(), 1000.0) << "nothing was added";
}

}  // namespace
}  // namespace semblante

#include "core/performance/idle.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/performance/performance.h"

namespace semblante {
namespace {

std::vector<double> blink_times(const IdleLife& idle, double minutes) {
  std::vector<double> times;
  bool shut = false;
  for (double t = 0.0; t < minutes * 60'000.0; t += 10.0) {
    const bool now = idle_at(idle, t).lid_closure > 0.5;
    if (now && !shut) times.push_back(t);
    shut = now;
  }
  return times;
}

TEST(Idle, Blinks_ComeAtTheRateAndIrregularly) {
  const IdleLife idle{7, 15.0, 0.3, 0.5};
  const auto times = blink_times(idle, 40.0);
  EXPECT_NEAR(static_cast<double>(times.size()), 600.0, 3.0);
  std::vector<double> gaps;
  for (std::size_t i = 1; i < times.size(); ++i) gaps.push_back(times[i] - times[i - 1]);
  std::sort(gaps.begin(), gaps.end());
  EXPECT_GT(gaps.front(), 400.0);
  EXPECT_LT(gaps.back(), 16'000.0);
  EXPECT_LT(gaps[gaps.size() / 2], 3700.0) << "more short ones than long ones: the median is below the mean of 4 s";
  EXPECT_GT(gaps[gaps.size() * 9 / 10], 7000.0);
  EXPECT_TRUE(blink_times({7, 0.0, 0.0, 0.0}, 5.0).empty());
}

TEST(Idle, SameSeed_SameLifeWhereverItStarts) {
  const IdleLife idle{11, 20.0, 1.0, 1.0};
  const IdleLife other{12, 20.0, 1.0, 1.0};
  double apart = 0.0;
  for (double t = 0.0; t < 100'000.0; t += 333.0) {
    EXPECT_EQ(idle_at(idle, t).head_yaw, idle_at(idle, t).head_yaw);
    apart = std::max(apart, std::abs(idle_at(idle, t).head_yaw - idle_at(other, t).head_yaw));
  }
  EXPECT_GT(apart, 2.0);
}

TEST(Idle, Motion_IsContinuousAndSmall) {
  const IdleLife idle{3, 30.0, 1.0, 1.0};
  IdleMotion before = idle_at(idle, 0.0);
  double widest = 0.0;
  for (double t = 1.0; t < 300'000.0; t += 1.0) {
    const IdleMotion now = idle_at(idle, t);
    ASSERT_LT(std::abs(now.head_yaw - before.head_yaw), 0.03) << t;
    ASSERT_LT(std::abs(now.head_pitch - before.head_pitch), 0.03) << t;
    ASSERT_LT(std::abs(now.eye_yaw - before.eye_yaw), 0.6) << t;
    ASSERT_LT(std::abs(now.lid_closure - before.lid_closure), 0.025) << t;
    ASSERT_LE(std::abs(now.head_yaw), 5.0);
    widest = std::max(widest, std::abs(now.head_yaw));
    before = now;
  }
  EXPECT_GT(widest, 2.5);
}

TEST(Idle, OnlyIdle_HasNoEndAndRunsOnOverLoops) {
  const auto made = Performance::compile({"", std::nullopt, IdleLife{5, 15.0, 1.0, 0.5}, {}});
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->endless());
  EXPECT_NE(made->frame_at(0.0, 70'000.0).fap[49], made->frame_at(0.0, 90'000.0).fap[49]);
}

}  // namespace
}  // namespace semblante

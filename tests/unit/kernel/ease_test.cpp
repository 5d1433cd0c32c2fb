#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/kernel/semblante_ease.h"

namespace {

semblante_pose pose_with(float value, float angle = 0.0F) {
  semblante_pose pose{};
  pose.fp[5] = value;
  pose.tongue_roll = value;
  for (auto* q : {pose.eye_rotation[0], pose.eye_rotation[1], pose.head_rotation}) {
    q[1] = std::sin(0.5F * angle);
    q[3] = std::cos(0.5F * angle);
  }
  return pose;
}

/// A path through values at uneven times.
struct Path {
  std::vector<float> times, values;
  float at(float time) const {
    std::size_t i = 1;
    while (i + 2 < times.size() && time > times[i + 1]) ++i;
    const auto pose = [&](std::size_t k) { return pose_with(values[k], 0.3F * values[k]); };
    const std::array<float, 3> spans = {times[i] - times[i - 1], times[i + 1] - times[i],
                                        i + 2 < times.size() ? times[i + 2] - times[i + 1] : 0.0F};
    const auto a = pose(i - 1);
    const auto b = pose(i);
    const auto c = pose(i + 1);
    const auto d = pose(std::min(i + 2, times.size() - 1));
    semblante_pose out;
    semblante_ease(&a, &b, &c, &d, spans.data(), (time - times[i]) / spans[1], &out);
    EXPECT_EQ(out.fp[5], out.tongue_roll);
    return out.fp[5];
  }
};

Path random_path() {
  std::mt19937 random(3);
  Path path;
  float time = 0.0F;
  for (int i = 0; i < 60; ++i) {
    path.times.push_back(time);
    path.values.push_back(static_cast<float>(random() % 1000) / 100.0F);
    time += 0.5F + static_cast<float>(random() % 100) / 100.0F;
  }
  return path;
}

TEST(Kernel_Ease, GoesThroughThePosesAndNeverBeyondThem) {
  const Path path = random_path();
  for (std::size_t i = 1; i + 1 < path.times.size(); ++i) {
    EXPECT_NEAR(path.at(path.times[i]), path.values[i], 1e-4F);
    const auto [low, high] = std::minmax(path.values[i], path.values[i + 1]);
    float before = path.values[i];
    for (float t = 0.0F; t <= 1.0F; t += 0.05F) {
      const float now = path.at(path.times[i] + t * (path.times[i + 1] - path.times[i]));
      ASSERT_GE(now, low - 1e-4F);
      ASSERT_LE(now, high + 1e-4F);
      ASSERT_GE((now - before) * (path.values[i + 1] - path.values[i]), -1e-4F) << "on its way it never turns back";
      before = now;
    }
  }
}

TEST(Kernel_Ease, HasNoCorners) {
  const Path path = random_path();
  const float h = 1e-2F;
  float worst = 0.0F;
  float worst_linear = 0.0F;
  for (std::size_t i = 2; i + 2 < path.times.size(); ++i) {
    const float t = path.times[i];
    const float left = (path.at(t) - path.at(t - h)) / h;
    const float right = (path.at(t + h) - path.at(t)) / h;
    worst = std::max(worst, std::abs(right - left));
    const float in = (path.values[i] - path.values[i - 1]) / (path.times[i] - path.times[i - 1]);
    const float out = (path.values[i + 1] - path.values[i]) / (path.times[i + 1] - path.times[i]);
    worst_linear = std::max(worst_linear, std::abs(out - in));
  }
  EXPECT_LT(worst, 0.1F * worst_linear) << "what is left of the bend within 1/100 on both sides";
}

TEST(Kernel_Ease, EvenMotion_StaysEven) {
  const auto a = pose_with(1.0F);
  const auto b = pose_with(2.0F);
  const auto c = pose_with(3.0F);
  const auto d = pose_with(4.0F);
  const std::array<float, 3> spans = {40.0F, 40.0F, 40.0F};
  semblante_pose out;
  for (float t = 0.0F; t < 1.0F; t += 0.1F) {
    semblante_ease(&a, &b, &c, &d, spans.data(), t, &out);
    EXPECT_NEAR(out.fp[5], 2.0F + t, 1e-5F);
  }
}

TEST(Kernel_Ease, Rotations_GoTheShorterWayAndStayOne) {
  auto a = pose_with(0.0F, -0.4F);
  auto b = pose_with(0.0F, 0.0F);
  auto c = pose_with(0.0F, 0.5F);
  auto d = pose_with(0.0F, 0.7F);
  for (auto* pose : {&a, &c}) {
    for (float& x : pose->head_rotation) x = -x;  // the same rotations, written the other way
  }
  const std::array<float, 3> spans = {1.0F, 1.0F, 1.0F};
  float before = 0.0F;
  for (int i = 0; i <= 20; ++i) {
    semblante_pose out;
    semblante_ease(&a, &b, &c, &d, spans.data(), static_cast<float>(i) / 20.0F, &out);
    const float* q = out.head_rotation;
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0F, 1e-5F);
    const float angle = 2.0F * std::atan2(std::abs(q[1]), std::abs(q[3]));
    EXPECT_GE(angle, before - 1e-4F);
    EXPECT_LE(angle, 0.5F + 1e-4F);
    before = angle;
  }
  EXPECT_NEAR(before, 0.5F, 1e-3F);
}

TEST(Kernel_Ease, WithoutNeighbours_ItBeginsAndEndsAtRest) {
  const auto a = pose_with(1.0F);
  const auto b = pose_with(2.0F);
  const std::array<float, 3> spans = {0.0F, 40.0F, 0.0F};
  semblante_pose out;
  semblante_ease(&a, &a, &b, &b, spans.data(), 0.25F, &out);
  EXPECT_NEAR(out.fp[5], 1.0F + 0.25F * 0.25F * 2.5F, 1e-5F);
  semblante_ease(&a, &a, &b, &b, spans.data(), 1.0F, &out);
  EXPECT_EQ(out.fp[5], 2.0F);
  out = a;
  semblante_ease(&out, &out, &b, &b, spans.data(), 0.5F, &out);
  EXPECT_NEAR(out.fp[5], 1.5F, 1e-5F) << "out may be one of them";
}

}  // namespace

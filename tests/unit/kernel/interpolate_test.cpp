// Interpolation of poses.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/kernel/semblante_kernel.h"
#include "tests/unit/kernel/kernel_rig.h"
#include "tests/unit/kernel/random_case.h"

namespace semblante::testing {
namespace {

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
}  // namespace semblante::testing

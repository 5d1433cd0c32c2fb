#include "clients/native/viewer/pace.h"

#include <vector>

#include <gtest/gtest.h>

namespace semblante::testing {
namespace {

using viewer::Pace;

/// The steps of some seconds at a rate.
std::vector<Pace::Step> steps(Pace& pace, double rate, double seconds, bool has_smaller_level = true) {
  std::vector<Pace::Step> taken;
  for (int i = 0; i < static_cast<int>(rate * seconds); ++i) {
    if (const auto step = pace.tick(1 / rate, has_smaller_level); step != Pace::Step::none) taken.push_back(step);
  }
  return taken;
}

TEST(Pace, ThirtyASecond_KeepsTheBest) {
  Pace pace;
  EXPECT_TRUE(steps(pace, 30, 60).empty());
  EXPECT_EQ(pace.effort().samples, 4);
}

TEST(Pace, ASlowDevice_GivesUpShadowsThenEdgesThenVertices) {
  Pace pace;
  EXPECT_EQ(steps(pace, 12, 2.5), std::vector{Pace::Step::effort});
  EXPECT_LT(pace.effort().shadow_side, 2048);
  EXPECT_EQ(pace.effort().samples, 4);
  EXPECT_EQ(steps(pace, 12, 2.5), std::vector{Pace::Step::effort});
  EXPECT_EQ(pace.effort().samples, 1);
  EXPECT_EQ(steps(pace, 12, 2.5), std::vector{Pace::Step::smaller_level});
  EXPECT_TRUE(steps(pace, 12, 10, false).empty()) << "there is no smaller level";
}

TEST(Pace, AnInterruption_IsNotSlowness) {
  Pace pace;
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(steps(pace, 60, 1.5).empty());
    EXPECT_EQ(pace.tick(3.0, true), Pace::Step::none);
  }
}

}  // namespace
}  // namespace semblante::testing

#include "core/performance/sine_and_cosine.h"

#include <gtest/gtest.h>

namespace semblante {
namespace {

TEST(SineAndCosine, OfAnglesWithinFiveTurns_AreThoseOfTheCLibrary) {
  for (int i = -36000; i <= 36000; ++i) {
    const double angle = i * std::numbers::pi / 3600.0;
    const auto [sine, cosine] = sine_and_cosine(angle);
    // Beyond a quarter turn the angle's own rounding counts: 5 turns are 32 radians.
    EXPECT_NEAR(sine, std::sin(angle), 1e-14) << angle;
    EXPECT_NEAR(cosine, std::cos(angle), 1e-14) << angle;
    if (i >= -900 && i <= 900) {
      EXPECT_NEAR(sine, std::sin(angle), 2.5e-16) << angle;
      EXPECT_NEAR(cosine, std::cos(angle), 2.5e-16) << angle;
    }
  }
}

}  // namespace
}  // namespace semblante

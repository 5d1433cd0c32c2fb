#include "core/parametrize/non_negative_kriging.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace semblante {
namespace {

constexpr std::size_t both[] = {0, 1};

TEST(NonNegativeKriging_Solve, IsPlainKrigingWhereThatIsPositive) {
  NonNegativeKriging kriging({1.0, 0.5, 0.5, 1.0}, 2);
  const double k[] = {0.8, 0.7};

  const auto w = kriging.solve(both, k);

  // 1 / (1 - 0.25) * (0.8 - 0.5 * 0.7, 0.7 - 0.5 * 0.8) = 4/3 * (0.45, 0.30)
  EXPECT_NEAR(w[0], 0.6, 1e-12);
  EXPECT_NEAR(w[1], 0.4, 1e-12);
}

TEST(NonNegativeKriging_Solve, LeavesOutASiteThatWouldBeNegative) {
  NonNegativeKriging kriging({1.0, 0.5, 0.5, 1.0}, 2);
  const double k[] = {0.9, 0.3};

  const auto w = kriging.solve(both, k);

  // Free: 4/3 * (0.9 - 0.15, 0.3 - 0.45) = (1, -0.2). Without the second the first alone has 0.9 / 1.
  EXPECT_NEAR(w[0], 0.9, 1e-12);
  EXPECT_EQ(w[1], 0.0);
}

TEST(NonNegativeKriging_Solve, IsEmptyWithoutSites) {
  NonNegativeKriging kriging({1.0}, 1);
  EXPECT_TRUE(kriging.solve({}, {}).empty());
}

// The conditions of Karush, Kuhn and Tucker hold at the solution of a convex problem and nowhere else.
TEST(NonNegativeKriging_Solve, MeetsTheOptimalityConditionsOnRandomSites) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(0.0, 1.0);
  std::size_t zeros = 0;
  for (int round = 0; round < 300; ++round) {
    const std::size_t count = 2 + random() % 30;
    std::vector<double> x(count), y(count);
    for (std::size_t i = 0; i < count; ++i) x[i] = anywhere(random), y[i] = anywhere(random);
    std::vector<double> covariance;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) covariance.push_back(std::exp(-std::hypot(x[i] - x[j], y[i] - y[j])));
    }
    NonNegativeKriging kriging(covariance, count);
    std::vector<std::size_t> sites;
    std::vector<double> k;
    const double tx = anywhere(random), ty = anywhere(random);
    for (std::size_t i = 0; i < count; i += 1 + random() % 2) {
      sites.push_back(i);
      k.push_back(anywhere(random) * std::exp(-std::hypot(x[i] - tx, y[i] - ty)));
    }

    const auto w = kriging.solve(sites, k);

    for (std::size_t s = 0; s < sites.size(); ++s) {
      double gain = k[s];
      for (std::size_t t = 0; t < sites.size(); ++t) gain -= covariance[sites[s] * count + sites[t]] * w[t];
      EXPECT_GE(w[s], 0.0);
      EXPECT_LE(gain, 1e-9);
      if (w[s] > 0.0) {
        EXPECT_NEAR(gain, 0.0, 1e-9);
      }
      zeros += w[s] == 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(zeros, 300U);  // else the constraint was never tried
}

}  // namespace
}  // namespace semblante

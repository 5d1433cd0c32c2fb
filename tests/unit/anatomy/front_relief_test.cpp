#include "core/anatomy/front_relief.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

using testing::make_ball;
using testing::make_box;

std::optional<FrontRelief> draw(const Model& model) { return FrontRelief::draw(build_surface(model), model.triangles); }

TEST(FrontRelief, OfABall_IsItsFront) {
  const auto relief = draw(make_ball({2.0F, 1.0F, 5.0F}, 1.0F, 64, 64));
  ASSERT_TRUE(relief);
  EXPECT_NEAR(relief->height(), 2.0, 0.02);
  EXPECT_NEAR(relief->width(), 2.0, 0.02);
  for (const double step : {0.001, 0.02, 0.1}) {
    const FrontRelief::Level& level = relief->with_step(step);
    EXPECT_NEAR(level.at(2.0, 1.0), 6.0, 0.02) << step;
    EXPECT_NEAR(level.at(2.6, 1.0), 5.8, 0.10) << step;
    EXPECT_TRUE(std::isnan(level.at(1.05, 0.05))) << step;
    EXPECT_TRUE(std::isnan(level.at(100.0, 1.0))) << step;
  }
}

TEST(FrontRelief, WithStep_IsTheCoarsestThatIsFineEnough) {
  const auto relief = draw(make_ball({0.0F, 0.0F, 0.0F}, 1.0F));
  ASSERT_TRUE(relief);
  const double finest = relief->finest().grid.step;
  EXPECT_EQ(relief->with_step(0.5 * finest).grid.step, finest);
  EXPECT_EQ(relief->with_step(3.9 * finest).grid.step, 2.0 * finest);
  EXPECT_EQ(relief->with_step(4.1 * finest).grid.step, 4.0 * finest);
}

TEST(FrontRelief, OfAHundredThousandPlatesOnTopOfEachOther_IsNotDrawn) {
  Model model = make_box({0.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F});
  const auto once = model.triangles;
  for (int k = 0; k < 10'000; ++k) model.triangles.insert(model.triangles.end(), once.begin(), once.end());
  EXPECT_FALSE(draw(model));
}

TEST(FrontRelief, OfALine_IsNone) {
  Model model = make_box({0.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F});
  for (glm::vec3& p : model.positions) p = {0.0F, 0.0F, p.z};
  EXPECT_FALSE(draw(model));
}

}  // namespace
}  // namespace semblante

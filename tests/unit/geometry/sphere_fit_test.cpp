#include "core/geometry/sphere_fit.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

std::vector<glm::dvec3> as_double(const std::vector<glm::vec3>& points) { return {points.begin(), points.end()}; }

TEST(SphereFit, Ball_GivesItsCenterAndRadius) {
  const auto sphere = fit_sphere(as_double(testing::make_ball({3, -2, 40}, 1.5F).positions));
  ASSERT_TRUE(sphere);
  EXPECT_LT(glm::distance(sphere->center, glm::dvec3(3, -2, 40)), 1e-5);
  EXPECT_NEAR(sphere->radius, 1.5, 1e-5);
  EXPECT_LT(sphere->rms_error, 1e-5);
}

TEST(SphereFit, FrontHalfOfABall_GivesTheSameSphere) {
  std::vector<glm::dvec3> front;
  for (const glm::dvec3& p : as_double(testing::make_ball({0, 0, 0}, 1.0F, 32, 16).positions)) {
    if (p.z > 0.1) front.push_back(p);
  }
  const auto sphere = fit_sphere(front);
  ASSERT_TRUE(sphere);
  EXPECT_LT(glm::length(sphere->center), 1e-5);
  EXPECT_NEAR(sphere->radius, 1.0, 1e-5);
}

TEST(SphereFit, FlatOrTooFewPoints_GiveNone) {
  EXPECT_FALSE(fit_sphere(as_double(testing::make_grid(4, 4).positions)));
  EXPECT_FALSE(fit_sphere(as_double({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})));
  EXPECT_FALSE(fit_sphere(as_double({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}})));
  EXPECT_FALSE(fit_sphere({}));
}

}  // namespace
}  // namespace semblante

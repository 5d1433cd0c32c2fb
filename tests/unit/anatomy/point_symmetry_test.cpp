#include "core/anatomy/point_symmetry.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "core/anatomy/reference_heads.h"
#include "core/types/places.h"

namespace semblante {
namespace {

/// A face of no human proportions, turned by `degrees` to its left.
Places creature(double degrees) {
  Places places = mean_of(reference_heads());
  const glm::dquat turn = glm::angleAxis(glm::radians(degrees), glm::dvec3(0.0, 1.0, 0.0));
  for (auto& place : places) {
    if (place) place = turn * (glm::dvec3(40.0, 12.0, 90.0) * *place + glm::dvec3(7.0, 0.0, 0.0));
  }
  return places;
}

double turn_of(const MirrorPlane& plane) { return glm::degrees(std::atan2(-plane.normal.z, plane.normal.x)); }

TEST(PointSymmetry, OfACreatureThatIsTurned_IsItsPlane) {
  for (const double degrees : {-25.0, -15.0, 0.0, 8.0, 15.0}) {
    const auto symmetry = symmetry_of_points(creature(degrees));
    ASSERT_TRUE(symmetry) << degrees;
    EXPECT_NEAR(turn_of(symmetry->plane), degrees, 0.5);
    EXPECT_NEAR(symmetry->plane.offset, 7.0, 1.0);
    EXPECT_LT(symmetry->off, 0.01);
  }
}

TEST(PointSymmetry, WithAFifthOfThePointsAstray_IsTheSame) {
  Places places = creature(15.0);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> astray(-25.0, 25.0);
  for (std::size_t id = 0; id < feature_point_count; id += 10) {
    if (places[id]) *places[id] += glm::dvec3(astray(random), astray(random), astray(random));
  }
  const auto symmetry = symmetry_of_points(places);
  ASSERT_TRUE(symmetry);
  EXPECT_NEAR(turn_of(symmetry->plane), 15.0, 1.0);
}

TEST(PointSymmetry, OfPointsInDisorder_IsNone) {
  Places places = creature(0.0);
  std::mt19937 random(3);
  std::shuffle(places.begin(), places.end(), random);
  EXPECT_FALSE(symmetry_of_points(places));
  EXPECT_FALSE(symmetry_of_points({}));
}

}  // namespace
}  // namespace semblante

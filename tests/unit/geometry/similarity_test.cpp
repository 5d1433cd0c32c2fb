#include "core/geometry/similarity.h"

#include <array>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

namespace semblante {
namespace {

constexpr std::array<glm::dvec3, 4> corners = {glm::dvec3{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 3}};

TEST(Similarity, FindsScaleRotationAndShift) {
  const glm::dmat3 rotation = glm::mat3_cast(glm::normalize(glm::dquat(0.3, -0.5, 0.7, 0.1)));
  std::array<glm::dvec3, 4> moved{};
  for (std::size_t i = 0; i < corners.size(); ++i) moved[i] = 2.5 * (rotation * corners[i]) + glm::dvec3(4, -1, 7);
  const auto fit = fit_similarity(corners, moved);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->scale, 2.5, 1e-9);
  for (std::size_t i = 0; i < corners.size(); ++i) EXPECT_LT(glm::distance((*fit)(corners[i]), moved[i]), 1e-9);
}

TEST(Similarity, NeverMirrors) {
  std::array<glm::dvec3, 4> mirrored = corners;
  for (glm::dvec3& p : mirrored) p.x = -p.x;
  const auto fit = fit_similarity(corners, mirrored);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(glm::determinant(fit->rotation), 1.0, 1e-9);
}

TEST(Similarity, IsEmptyForTooFewPointsOrPointsOnALine) {
  const std::array<glm::dvec3, 4> line = {glm::dvec3{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {5, 5, 0}};
  const std::array<glm::dvec3, 4> one_place{};
  EXPECT_FALSE(fit_similarity(line, corners));
  EXPECT_FALSE(fit_similarity(corners, line));
  EXPECT_FALSE(fit_similarity(one_place, corners));
  EXPECT_FALSE(fit_similarity(std::span(corners).first(2), std::span(corners).first(2)));
}

TEST(PrincipalAxis, IsTheOneOfTheLargestEigenvalueEvenBelowZero) {
  glm::dmat4 matrix{0.0};
  matrix[0][0] = -5.0;
  matrix[1][1] = -1.0;
  matrix[2][2] = -4.0;
  matrix[3][3] = -2.0;
  EXPECT_NEAR(std::abs(principal_axis(matrix)[1]), 1.0, 1e-9);
}

}  // namespace
}  // namespace semblante

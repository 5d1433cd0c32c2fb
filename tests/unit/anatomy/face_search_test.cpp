#include "core/anatomy/face_search.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "core/anatomy/front_relief.h"
#include "tests/support/sample_head_model.h"

namespace semblante {
namespace {

constexpr double most_slope = 0.06;

glm::dmat3 rotation(double degrees, const glm::dvec3& axis) {
  return glm::mat3_cast(glm::angleAxis(glm::radians(degrees), axis));
}

FrontRelief relief_of(const glm::dmat3& turn) {
  const Model model = testing::sample_head_model();
  return *FrontRelief::draw(build_surface(model), model.triangles, turn);
}

TEST(FaceSearch, OfAnUprightFace_HasNoSlopes) {
  const auto face = search_face(relief_of(glm::dmat3(1.0)), reference_heads());
  ASSERT_TRUE(face);
  EXPECT_LT(glm::length(face->slopes), most_slope);
}

TEST(FaceSearch, OfAFaceThatLooksAside_HasTheTangentOfItsAngle) {
  for (const double degrees : {-20.0, 15.0}) {
    const auto face = search_face(relief_of(rotation(degrees, {0.0, 1.0, 0.0})), reference_heads());
    ASSERT_TRUE(face) << degrees;
    EXPECT_NEAR(face->slopes.x, -std::tan(glm::radians(degrees)), 0.1) << degrees;
    EXPECT_NEAR(face->slopes.y, 0.0, most_slope) << degrees;
  }
}

TEST(FaceSearch, OfALeaningFace_TurnsItUpright) {
  for (const double degrees : {-20.0, 10.0}) {
    const glm::dmat3 lean = rotation(degrees, {0.0, 0.0, 1.0});
    const auto face = search_leaning_face(relief_of(lean), reference_heads());
    ASSERT_TRUE(face) << degrees;
    const glm::dmat3 upright = face->frame.rotation * lean;
    EXPECT_GT(upright[0][0], std::cos(glm::radians(3.0))) << degrees;
  }
}

}  // namespace
}  // namespace semblante

// A head that is tilted in its file is turned upright by its points.
#include "core/anatomy/face_tilt.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "core/tables/mpeg4.h"
#include "core/types/places.h"
#include "tests/unit/frame/turned_heads.h"

namespace semblante::test {
namespace {

glm::dmat3 rotation(double degrees, const glm::dvec3& axis) {
  return glm::mat3_cast(glm::angleAxis(glm::radians(degrees), glm::normalize(axis)));
}

std::vector<PlacedPoint> rotated(std::vector<PlacedPoint> points, const glm::dmat3& by) {
  for (PlacedPoint& point : points) point.position = by * point.position;
  return points;
}

std::optional<glm::dmat3> upright_rotation_of(std::span<const PlacedPoint> points) {
  Places places;
  for (const PlacedPoint& point : points) places[point.id.value()] = point.position;
  return upright_rotation(places);
}

/// What a person marks: the middle, the left side and one point of the right one.
std::vector<PlacedPoint> of_one_side(std::vector<PlacedPoint> points) {
  std::erase_if(points, [](const PlacedPoint& point) {
    return mpeg4::feature_points[point.id.value()].side == mpeg4::Side::right && to_string(point.id) != "3.12";
  });
  return points;
}

struct Error {
  double across;  ///< of the direction to the face's left, degrees: yaw and roll
  double nod;     ///< degrees of pitch
};

Error error_of(const glm::dmat3& left_over) {
  const double across = std::acos(std::min(1.0, left_over[0][0]));
  return {glm::degrees(across), glm::degrees(std::abs(std::atan2(left_over[1][2], left_over[1][1])))};
}

TEST(FaceTilt, UprightHeads_AreUpright) {
  for (const Head& head : upright_heads()) {
    if (head.points.empty()) continue;
    EXPECT_FALSE(upright_rotation_of(head.points)) << head.name;
    EXPECT_FALSE(upright_rotation_of(of_one_side(head.points))) << head.name << ", one side";
    EXPECT_EQ(guess_frame(head.points, {}).tilt, glm::dmat3(1.0)) << head.name;
  }
}

TEST(FaceTilt, TiltedHeads_AreTurnedUpright) {
  for (const Head& head : upright_heads()) {
    if (head.points.empty()) continue;
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {-1, 0.5, 0.3}}) {
      for (const double degrees : {-40.0, -30.0, -20.0, 20.0, 30.0, 40.0}) {
        const glm::dmat3 in_file = rotation(degrees, axis);
        const auto said = [&] {
          return head.name + " by " + std::to_string(degrees) + " about " + std::to_string(axis.x) + " " +
                 std::to_string(axis.y) + " " + std::to_string(axis.z);
        };
        const ModelFrame all = guess_frame(rotated(head.points, in_file), {});
        EXPECT_TRUE(all.axes_sure) << said();
        const Error error = error_of(turn_upright(all) * in_file);
        EXPECT_LT(error.across, 2.0) << said();
        EXPECT_LT(error.nod, 10.0) << said();
      }
    }
  }
}

/// Of a length and a breadth that no person has.
std::vector<PlacedPoint> of_a_creature() {
  std::vector<PlacedPoint> points = upright_heads().front().points;
  for (PlacedPoint& point : points) point.position *= glm::dvec3(1.0, 0.5, 2.5);
  return points;
}

TEST(FaceTilt, OfACreature_IsThatOfItsPlaneOfSymmetry) {
  EXPECT_FALSE(upright_rotation_of(of_a_creature()));
  for (const glm::dvec3 axis : {glm::dvec3(0, 1, 0), {0, 0, 1}, {0, 1, 1}}) {
    for (const double degrees : {-20.0, -10.0, 10.0, 20.0}) {
      const glm::dmat3 in_file = rotation(degrees, axis);
      const auto upright = upright_rotation_of(rotated(of_a_creature(), in_file));
      ASSERT_TRUE(upright) << degrees;
      EXPECT_LT(error_of(*upright * in_file).across, 1.0) << degrees;
    }
  }
}

TEST(FaceTilt, AHeadThatIsUprightBefore_KeepsItsFrame) {
  const Head head = upright_heads().front();
  auto points = rotated(head.points, rotation(20.0, {0, 0, 1}));
  const ModelFrame first = guess_frame(points, {});
  ASSERT_NE(first.tilt, glm::dmat3(1.0));
  points.front().position += glm::dvec3(0.002, 0.001, 0.0);  // a point is moved by two millimetres
  EXPECT_EQ(guess_frame(points, first).tilt, first.tilt);
}

TEST(FaceTilt, PointsOfNoFace_ShowNone) {
  Head head = upright_heads().front();
  std::mt19937 random(3);
  std::shuffle(head.points.begin(), head.points.end(), random);
  std::vector<PlacedPoint> mixed = head.points;
  for (std::size_t i = 0; i < mixed.size(); ++i) mixed[i].position = head.points[(i + 7) % mixed.size()].position;
  EXPECT_FALSE(upright_rotation_of(mixed));
  EXPECT_FALSE(upright_rotation_of(rotated(of_one_side(upright_heads().front().points), rotation(20.0, {0, 1, 0}))));
  EXPECT_FALSE(upright_rotation_of(std::span(head.points).first(5)));
  EXPECT_FALSE(upright_rotation_of({}));
}

TEST(FaceTilt, AxesOfTheUser_AreTheHeads) {
  const Head head = upright_heads().front();
  const auto points = rotated(head.points, rotation(20.0, {1, 0, 0}));
  const ModelFrame guess = guess_frame(points, {});
  EXPECT_GT(tilt_of(guess), 10.0);
  EXPECT_EQ(apply_wish(guess, {{}, Direction::plus_y, Direction::plus_z}).tilt, glm::dmat3(1.0));
  EXPECT_EQ(apply_wish(guess, {LengthUnit::metre, {}, {}}).tilt, guess.tilt);
}

}  // namespace
}  // namespace semblante::test

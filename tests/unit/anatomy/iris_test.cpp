#include "core/anatomy/iris.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/anatomy/tongue_shape.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

constexpr float pi = 3.14159265F;

/// The front of a ball about the origin that looks along +z: rings at the given distances from the axis.
Model cap(float ball_radius, const std::vector<float>& rings, bool with_middle) {
  std::vector<glm::vec3> positions;
  std::vector<Triangle> triangles;
  const auto height = [&](float r) { return std::sqrt(ball_radius * ball_radius - r * r); };
  if (with_middle) positions.emplace_back(0.0F, 0.0F, ball_radius);
  constexpr std::uint32_t around = 8;
  for (const float r : rings) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (std::uint32_t k = 0; k < around; ++k) {
      const float a = 2.0F * pi * static_cast<float>(k) / around;
      positions.emplace_back(r * std::cos(a), r * std::sin(a), height(r));
    }
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t next = (k + 1) % around;
      if (first == 0) {
        if (k > 0 && next > 0) triangles.push_back({0, first + k, first + next});  // a flat octagon
      } else if (first == 1) {
        triangles.push_back({0, first + k, first + next});
      } else {
        triangles.push_back({first - around + k, first + k, first + next});
        triangles.push_back({first - around + k, first + next, first - around + next});
      }
    }
  }
  return testing::make_model(positions, triangles);
}

struct Found {
  std::optional<IrisOfEye> iris;
  std::string why_not;
};

/// Finds the iris of an eye that all parts of the model belong to; IRISD0 is 6. `ball_radius` 0: no part is a ball.
Found find(const Model& model, const FeaturePointSet& points, float ball_radius = 0.0F) {
  const Surface surface = build_surface(model);
  std::vector<Part> parts(surface.part_count());
  for (Part& part : parts) {
    part.role = PartRole::left_eye;
    part.box_min = glm::vec3(-ball_radius);
    part.box_max = glm::vec3(ball_radius);
  }
  Found found;
  found.iris = find_iris(model, surface, parts, PartRole::left_eye, points, glm::vec3(0.0F), 6.0, found.why_not);
  return found;
}

FeaturePointSet pupil_at(const Model& model, std::uint32_t vertex) {
  return {{testing::fp("3.5"), VertexId(vertex), model.positions[vertex]}};
}

Model joined(Model a, const Model& b) {
  const auto offset = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const Triangle& t : b.triangles) a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  a.primitives[0].triangle_count = static_cast<std::uint32_t>(a.triangles.size());
  return a;
}

TEST(Iris, OfABall_IsWithinIrisd0AndBentAsTheBall) {
  const Model ball = cap(10.0F, {0.5F, 1.0F, 2.0F, 3.5F, 5.0F}, true);
  const Found found = find(ball, pupil_at(ball, 0));
  ASSERT_TRUE(found.iris.has_value()) << found.why_not;
  EXPECT_LT(glm::distance(found.iris->shape.axis, glm::vec3(0, 0, 1)), 1e-6F);
  EXPECT_FLOAT_EQ(found.iris->shape.pupil_radius, 1.0F);
  EXPECT_FLOAT_EQ(found.iris->shape.iris_radius, 3.0F);
  EXPECT_NEAR(found.iris->shape.bend, -0.05F, 0.002F);
  EXPECT_EQ(found.iris->vertices.size(), 1U + 3U * 8U);
}

TEST(Iris, BehindLidsFarApart_IsNoLargerThanAChilds) {
  const Model ball = cap(5.0F, {0.5F, 1.0F, 2.0F, 2.7F, 2.9F, 4.0F}, true);
  const Found found = find(ball, pupil_at(ball, 0), 5.0F);
  ASSERT_TRUE(found.iris.has_value()) << found.why_not;
  EXPECT_FLOAT_EQ(found.iris->shape.iris_radius, 2.75F);  // 0.55 of 5; half of IRISD0 is 3
  EXPECT_EQ(found.iris->vertices.size(), 1U + 4U * 8U);
}

TEST(Iris, UnderACornea_MovesAlone) {
  const Model cornea = cap(10.0F, {1.0F, 2.0F, 4.0F, 6.0F}, true);
  const Model inner = cap(9.0F, {0.5F, 1.0F, 2.0F, 4.0F}, true);
  const Model both = joined(cornea, inner);
  const Found found = find(both, pupil_at(both, 0));
  ASSERT_TRUE(found.iris.has_value()) << found.why_not;
  const auto first_inner = static_cast<std::uint32_t>(cornea.positions.size());
  for (const SurfaceVertexId v : found.iris->vertices) EXPECT_GE(v.value(), first_inner);
  EXPECT_EQ(found.iris->vertices.size(), 1U + 3U * 8U);
}

TEST(Iris, InTheHoleOfABall_MovesAndSaysHowLargeItIs) {
  const Model white = cap(10.0F, {2.8F, 4.0F, 6.0F}, true);
  Model with_hole = white;
  with_hole.triangles.erase(with_hole.triangles.begin(), with_hole.triangles.begin() + 8);  // the fan in the middle
  with_hole.primitives[0].triangle_count = static_cast<std::uint32_t>(with_hole.triangles.size());
  const Model disc = cap(200.0F, {0.9F, 1.8F, 2.7F}, true);
  Model eye = joined(disc, with_hole);
  for (std::size_t v = 0; v < disc.positions.size(); ++v) eye.positions[v].z -= 191.0F;
  const Found found = find(eye, pupil_at(eye, 0));
  ASSERT_TRUE(found.iris.has_value()) << found.why_not;
  EXPECT_GT(found.iris->shape.bend, -0.02F);
  for (const std::uint32_t inside : {1U, 9U}) {
    EXPECT_TRUE(std::any_of(found.iris->vertices.begin(), found.iris->vertices.end(),
                            [&](SurfaceVertexId v) { return v.value() == inside; }));
  }
}

TEST(Iris, OfAnEyeWithoutAVertexAtThePupil_IsAboutTheMiddleOfTheFlatFaceThere) {
  const Model eye = cap(10.0F, {2.0F, 4.0F, 6.0F}, false);
  const Found found = find(eye, pupil_at(eye, 3));  // a corner of the octagon
  ASSERT_TRUE(found.iris.has_value()) << found.why_not;
  EXPECT_LT(glm::distance(found.iris->shape.axis, glm::vec3(0, 0, 1)), 1e-5F);
  EXPECT_EQ(found.iris->vertices.size(), 8U);
  EXPECT_LT(found.iris->shape.bend, 0.0F) << "one ring: bent as a ball is";
}

/// The middle of the cap is open, and with `depth` its rim has a wall that leads inwards. Looks along `axis`.
Model eye_with_a_hole(float hole, float depth, const glm::vec3& axis) {
  Model eye = cap(10.0F, {hole, 1.5F * hole, 2.0F, 2.9F, 4.0F, 6.0F}, false);
  eye.triangles.erase(eye.triangles.begin(), eye.triangles.begin() + 6);  // the octagon in the middle
  if (depth > 0.0F) {
    const auto inner = static_cast<std::uint32_t>(eye.positions.size());
    for (std::uint32_t k = 0; k < 8; ++k) eye.positions.push_back(eye.positions[k] - glm::vec3(0.0F, 0.0F, depth));
    for (std::uint32_t k = 0; k < 8; ++k) {
      const std::uint32_t next = (k + 1) % 8;
      eye.triangles.push_back({k, inner + k, next});
      eye.triangles.push_back({next, inner + k, inner + next});
    }
  }
  const glm::vec3 left = glm::normalize(glm::cross(glm::vec3(0.0F, 1.0F, 0.0F), axis));
  const glm::vec3 up = glm::cross(axis, left);
  for (glm::vec3& p : eye.positions) p = p.x * left + p.y * up + p.z * axis;
  eye.primitives[0].triangle_count = static_cast<std::uint32_t>(eye.triangles.size());
  return eye;
}

TEST(Iris, OfAPupilThatIsAHole_IsAboutTheHole_WhereverThePupilIsMarked) {
  const glm::vec3 axis = glm::normalize(glm::vec3(0.12F, -0.04F, 1.0F));
  for (const float depth : {0.0F, 0.5F}) {
    const Model eye = eye_with_a_hole(0.9F, depth, axis);
    // A corner of the rim, and a place on the film of tears over the eye.
    for (const glm::vec3& marked : {eye.positions[3], glm::vec3(0.0F, 0.0F, 11.0F)}) {
      const Found found = find(eye, {{testing::fp("3.5"), std::nullopt, marked}});
      ASSERT_TRUE(found.iris.has_value()) << found.why_not;
      EXPECT_LT(glm::distance(found.iris->shape.axis, axis), 1e-5F) << depth;
    }
  }
}

TEST(Iris, AHoleThatIsNoPupil_IsNotItsMiddle) {
  const glm::vec3 axis(0.0F, 0.0F, 1.0F);
  const FeaturePointSet marked = {{testing::fp("3.5"), std::nullopt, glm::vec3(0.0F, 0.0F, 10.0F)}};
  // A small bright disc over the iris, to one side: a ring as well, with its front inside.
  Model disc = cap(10.5F, {0.4F, 0.7F}, true);
  for (glm::vec3& p : disc.positions) p += glm::vec3(0.8F, 0.8F, 0.0F);
  // A pore at the border of the iris.
  const Model pore = eye_with_a_hole(0.9F, 0.0F, glm::normalize(glm::vec3(0.3F, 0.0F, 1.0F)));
  for (const Model& eye : {joined(cap(10.0F, {0.9F, 2.0F, 2.9F, 4.0F, 6.0F}, true), disc), pore}) {
    const Found found = find(eye, marked);
    ASSERT_TRUE(found.iris.has_value()) << found.why_not;
    EXPECT_LT(glm::distance(found.iris->shape.axis, axis), 1e-6F);
  }
}

TEST(Iris, OfAFlatEyeWithItsPivotInThePlane_IsNoDeeperThanWide) {
  Model eye = cap(10.0F, {2.0F, 4.0F}, false);
  for (glm::vec3& position : eye.positions) position.z = 1e-4F;
  const Found found = find(eye, {{testing::fp("3.5"), std::nullopt, glm::vec3(0.0F, 0.0F, 1e-4F)}});
  ASSERT_TRUE(found.iris.has_value()) << found.why_not;
  EXPECT_LT(found.iris->shape.bend, 0.0F);
  EXPECT_LE(std::abs(found.iris->shape.bend) * found.iris->shape.iris_radius, 1.001F);
}

/// A dense flat sheet in the place of an eye: its many coplanar triangles are no polygon with a corner at the pupil,
/// and joining them all to one would take longer than anybody waits.
TEST(Iris, OfADenseFlatSheet_IsAboutTheMarkedPoint) {
  constexpr std::uint32_t side = 401;
  constexpr float step = 8.0F / (side - 1);
  std::vector<glm::vec3> positions;
  std::vector<Triangle> triangles;
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      positions.emplace_back(static_cast<float>(x) * step - 4.0F, static_cast<float>(y) * step - 4.0F, 10.0F);
      if (x + 1 == side || y + 1 == side) continue;
      const std::uint32_t at = y * side + x;
      triangles.push_back({at, at + 1, at + side});
      triangles.push_back({at + 1, at + side + 1, at + side});
    }
  }
  const Model sheet = testing::make_model(positions, triangles);
  const std::uint32_t marked = (side / 2) * side + side / 2 + 3;
  const Found found = find(sheet, pupil_at(sheet, marked));
  ASSERT_TRUE(found.iris.has_value()) << found.why_not;
  EXPECT_LT(glm::distance(found.iris->shape.axis, glm::normalize(positions[marked])), 1e-6F);
}

TEST(Iris, IsNone_AndSaysWhy) {
  const Model coarse = cap(10.0F, {4.0F, 6.0F}, true);
  EXPECT_NE(find(coarse, pupil_at(coarse, 0)).why_not.find("no vertices between"), std::string::npos);
  EXPECT_NE(find(coarse, {}).why_not.find("3.5 is not marked"), std::string::npos);
  std::string why_not;
  const Surface surface = build_surface(coarse);
  EXPECT_FALSE(find_iris(coarse, surface, {}, PartRole::left_eye, pupil_at(coarse, 0), {}, 6.0, why_not));
  EXPECT_EQ(why_not, "is no part");
  std::vector<Part> parts(1);
  parts[0].role = PartRole::left_eye;
  EXPECT_FALSE(find_iris(coarse, surface, parts, PartRole::left_eye, pupil_at(coarse, 0), {}, std::nullopt, why_not));
  EXPECT_NE(why_not.find("IRISD"), std::string::npos);
}

/// A sheet 4 wide and 10 long, from z = 0 at its root to its tip.
TEST(Tongue, IsASheetAlongZ_HeldAtItsRoot) {
  Model sheet = testing::make_grid(4, 10);
  for (glm::vec3& p : sheet.positions) p = {p.x - 2.0F, 0.0F, p.y};
  const Surface surface = build_surface(sheet);
  std::vector<Part> parts(1);
  parts[0].role = PartRole::tongue;
  const auto tongue = find_tongue(surface, parts, {}, share_of_jaw(surface, parts, {}));
  ASSERT_TRUE(tongue.has_value());
  EXPECT_LT(glm::distance(tongue->shape.left, glm::vec3(1, 0, 0)), 1e-5F);
  EXPECT_LT(glm::distance(tongue->shape.up, glm::vec3(0, 1, 0)), 1e-5F);
  EXPECT_FLOAT_EQ(tongue->shape.half_width, 2.0F);
  EXPECT_GT(tongue->shape.roll_limit, 1.5F);
  EXPECT_LT(tongue->shape.roll_limit, pi);
  for (std::uint32_t s = 0; s < surface.vertex_count(); ++s) {
    const double z = surface.positions[s].z;
    if (z < 0.01) {
      EXPECT_EQ(tongue->share[s], 0.0);
    }
    if (z > 3.6) {
      EXPECT_EQ(tongue->share[s], 1.0);
    }
  }
  parts[0].role = PartRole::skin;
  EXPECT_FALSE(find_tongue(surface, parts, {}, share_of_jaw(surface, parts, {})).has_value());
}

TEST(RigidMotion, SharesOfTheRollAreInSteps) {
  EXPECT_EQ(tongue_motion(0.0), RigidMotion::none);
  EXPECT_EQ(tongue_motion(0.003), RigidMotion::none);
  EXPECT_EQ(tongue_motion(1.0), RigidMotion::tongue);
  for (int step = 1; step <= 128; ++step) {
    EXPECT_DOUBLE_EQ(tongue_share(tongue_motion(step / 128.0)), step / 128.0);
    EXPECT_TRUE(is_rigid_motion(static_cast<std::uint8_t>(tongue_motion(step / 128.0))));
  }
  EXPECT_FALSE(is_rigid_motion(7));
  EXPECT_FALSE(is_rigid_motion(127));
}

}  // namespace
}  // namespace semblante

// Guessed roles on the heads of our own family, and what follows from them.

#include <gtest/gtest.h>

#include "core/anatomy/part_roles.h"
#include "core/parametrize/parametrize.h"
#include "tests/support/sample_head_model.h"

namespace semblante {
namespace {

PartRole true_role(const std::string& part) {
  if (part == "left eye") return PartRole::left_eye;
  if (part == "right eye") return PartRole::right_eye;
  if (part == "upper teeth") return PartRole::upper_teeth;
  if (part == "lower teeth") return PartRole::lower_teeth;
  if (part == "tongue") return PartRole::tongue;
  if (part == "skin" || part == "upper lids" || part == "scan") return PartRole::skin;
  return PartRole::rest;
}

class FamilyRoles : public ::testing::TestWithParam<testing::FamilyMember> {
 protected:
  void expect_roles(bool has_points, bool has_names) const {
    SCOPED_TRACE(std::string(has_points ? "points" : "no points") + (has_names ? ", names" : ", no names"));
    Model model = testing::sample_head_model(GetParam().traits);
    const std::vector<Primitive> named = model.primitives;
    if (!has_names) {
      for (Primitive& p : model.primitives) p = {"", -1, p.first_triangle, p.triangle_count};
    }
    const Surface surface = build_surface(model);
    const auto parts =
        describe_parts(model, surface, has_points ? testing::sample_head_points(GetParam().traits) : FeaturePointSet{});
    for (const Primitive& primitive : named) {
      const std::uint32_t vertex = model.triangles[primitive.first_triangle][0];
      const PartRole role = parts[surface.part_of[surface.surface_of[vertex].value()].value()].role;
      // Lids of their own are skin by their points; without, they look like a part of the eye.
      if (primitive.name == "upper lids" && !has_points) continue;
      // By place alone, which teeth are the upper ones is a guess.
      if (primitive.name.ends_with("teeth") && !has_points && !has_names) {
        EXPECT_TRUE(role == PartRole::upper_teeth || role == PartRole::lower_teeth) << primitive.name;
        continue;
      }
      EXPECT_EQ(role, true_role(primitive.name))
          << primitive.name << " is " << part_role_names[static_cast<std::size_t>(role)];
    }
  }
};

TEST_P(FamilyRoles, ByPointsAndNames) { expect_roles(true, true); }
TEST_P(FamilyRoles, ByPointsAlone) { expect_roles(true, false); }
TEST_P(FamilyRoles, ByNamesAlone) { expect_roles(false, true); }
TEST_P(FamilyRoles, ByPlaceAlone) { expect_roles(false, false); }

/// The rows of a part's vertices have this share of the jaw, 2.1.
TEST_P(FamilyRoles, LowerTeethGoWithTheJaw_UpperOnesStay) {
  const Model model = testing::sample_head_model(GetParam().traits);
  const auto rig = parametrize(model, build_surface(model), testing::sample_head_points(GetParam().traits));
  ASSERT_TRUE(rig);
  for (const Primitive& primitive : model.primitives) {
    const bool is_lower = primitive.name == "lower teeth";
    if (!is_lower && primitive.name != "upper teeth") continue;
    for (std::uint32_t t = 0; t < primitive.triangle_count; ++t) {
      for (const std::uint32_t v : model.triangles[primitive.first_triangle + t]) {
        const auto ids = rig->influence.points_of(v);
        const float share =
            ids.empty() || ids[0] != parse_feature_point("2.1") ? 0.0F : rig->influence.weights_of(v)[0];
        ASSERT_EQ(share, is_lower ? 1.0F : 0.0F) << primitive.name << ", vertex " << v;
      }
    }
  }
}

// Clothes, hands and shoes stay when the head turns; hair and eyes go with it.
TEST_P(FamilyRoles, TheHeadTurnsWithoutTheBody) {
  const Model model = testing::sample_head_model(GetParam().traits);
  const Surface surface = build_surface(model);
  const auto rig = parametrize(model, surface, testing::sample_head_points(GetParam().traits));
  ASSERT_TRUE(rig);
  for (const Primitive& primitive : model.primitives) {
    const std::uint32_t vertex = model.triangles[primitive.first_triangle][0];
    const PartRole role = rig->parts[rig->part_of_vertex[vertex].value()].role;
    if (primitive.name == "hair" || primitive.name == "left eye") {
      EXPECT_NE(role, PartRole::body) << primitive.name;
    }
    for (const char* const below : {"shirt", "torso", "sleeves", "hands", "hips", "legs", "shoes"}) {
      if (primitive.name != below) continue;
      EXPECT_EQ(role, PartRole::body) << primitive.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Family, FamilyRoles, ::testing::ValuesIn(testing::sample_family()), testing::member_name);

}  // namespace
}  // namespace semblante

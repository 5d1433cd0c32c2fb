#include "core/anatomy/part_roles.h"

#include <gtest/gtest.h>

#include "core/anatomy/role_by_name.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

/// A cartoon of a head, ES0 = 6: a plate of skin at z = 0 from (-10, -12) to (10, 12), eyeballs that look through it at
/// (3, 4) and (-3, 4), teeth and a tongue behind the mouth at (0, -3), lashes, hair.
class CartoonHead : public ::testing::Test {
 protected:
  CartoonHead() {
    Model plate = testing::make_grid(40, 48);
    for (glm::vec3& p : plate.positions) p = glm::vec3(p.x / 2 - 10, p.y / 2 - 12, 0);
    add(plate, "head");
  }
  std::uint32_t add(const Model& part, const std::string& name) {
    return testing::append(model_, part, with_names_ ? name : "");
  }
  void add_all() {
    add(testing::make_ball({3, 4, -1.2F}, 1.3F), "EyeLeft");
    add(testing::make_ball({-3, 4, -1.2F}, 1.3F), "EyeRight");
    add(testing::make_ball({3, 4, -0.5F}, 0.5F), "iris");
    add(arch(-2.0F), "TeethUpper");
    add(arch(-4.0F), "TeethLower");
    add(testing::make_box({-1.5F, -4.5F, -6}, {1.5F, -3.2F, -2}), "");
    // A closed box has no vertex in its middle; a tongue has.
    model_.positions.emplace_back(0.1F, -3.2F, -4);
    model_.positions.emplace_back(-0.1F, -3.2F, -4);
    model_.positions.emplace_back(0, -3.1F, -4);
    const auto top = static_cast<std::uint32_t>(model_.positions.size());
    model_.triangles.push_back({top - 3, top - 2, top - 1});
    model_.triangles.push_back({top - 3, top - 2, top - 4});
    model_.primitives.back().triangle_count += 2;
    add(testing::make_box({2, 5, 0.1F}, {4, 5.2F, 0.6F}), "lashes");
    add(testing::make_ball({0, 8, -6}, 9), "hair");
    surface_ = build_surface(model_);
  }
  /// Half a ring of teeth, open to the back.
  static Model arch(float y) {
    std::vector<glm::vec3> positions;
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i <= 12; ++i) {
      const double angle = 3.14159 * i / 12;
      for (const float h : {-0.7F, 0.7F}) {
        positions.emplace_back(2.5 * std::cos(angle), y + h, -4.5 + 3.5 * std::sin(angle));
      }
      if (i == 12) break;
      triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
      triangles.push_back({2 * i + 1, 2 * i + 2, 2 * i + 3});
    }
    return testing::make_model(positions, triangles);
  }
  [[nodiscard]] FeaturePointSet face_points() const {
    const auto at = [&](float x, float y) { return static_cast<std::uint32_t>((y + 12) * 2 * 41 + (x + 10) * 2); };
    return testing::points_at(model_, {{"2.1", at(0, -7)},
                                       {"2.2", at(0, -3)},
                                       {"2.3", at(0, -3.5F)},
                                       {"3.1", at(3, 5)},
                                       {"3.2", at(-3, 5)},
                                       {"3.3", at(3, 3)},
                                       {"3.4", at(-3, 3)}});
  }
  [[nodiscard]] std::vector<std::string> roles(const FeaturePointSet& points) const {
    std::vector<std::string> names;
    for (const Part& part : describe_parts(model_, surface_, points)) {
      names.emplace_back(part_role_names[static_cast<std::size_t>(part.role)]);
    }
    return names;
  }

  bool with_names_ = true;
  Model model_;
  Surface surface_;
};

const std::vector<std::string> cartoon_roles = {"skin",        "left_eye", "right_eye", "left_eye", "upper_teeth",
                                                "lower_teeth", "tongue",   "attached",  "rest"};

TEST_F(CartoonHead, WithoutNames_PlaceAndSizeTellTheParts) {
  with_names_ = false;
  add_all();
  EXPECT_EQ(roles(face_points()), cartoon_roles);
}

TEST_F(CartoonHead, WithoutPoints_NamesTell) {
  add_all();
  EXPECT_EQ(roles({}), cartoon_roles);
}

TEST_F(CartoonHead, PointsOnAPart_BeatItsName) {
  const std::uint32_t ball = add(testing::make_ball({3, 4, -1.2F}, 1.3F), "hair clip");
  surface_ = build_surface(model_);
  FeaturePointSet points = testing::points_at(model_, {{"2.1", 5}, {"3.5", ball}});
  EXPECT_EQ(describe_parts(model_, surface_, points)[1].role, PartRole::left_eye);
}

TEST_F(CartoonHead, RoleByUser_BeatsEverything) {
  const std::uint32_t ball = add(testing::make_ball({3, 4, -1.2F}, 1.3F), "EyeLeft");
  surface_ = build_surface(model_);
  const FeaturePointSet points = testing::points_at(model_, {{"2.1", 5}, {"3.5", ball}});
  const std::vector<std::optional<PartRole>> by_user = {std::nullopt, PartRole::rest};
  const auto parts = describe_parts(model_, surface_, points, by_user);
  EXPECT_EQ(parts[1].role, PartRole::rest);
  EXPECT_TRUE(parts[1].role_by_user);
  EXPECT_FALSE(parts[0].role_by_user);
}

TEST_F(CartoonHead, Facts_AreThoseOfThePart) {
  add(testing::make_box({2, 5, 0.25F}, {4, 5.5F, 0.5F}), "lashes");
  surface_ = build_surface(model_);
  const Part part = describe_parts(model_, surface_, {})[1];
  EXPECT_EQ(part.name, "lashes");
  EXPECT_EQ(part.vertex_count, 8U);
  EXPECT_EQ(part.triangle_count, 12U);
  EXPECT_EQ(part.box_min, glm::vec3(2, 5, 0.25F));
  EXPECT_EQ(part.box_max, glm::vec3(4, 5.5F, 0.5F));
}

TEST_F(CartoonHead, VerticesWithoutTriangles_AreOnePartAtRest) {
  model_.positions.emplace_back(0, 0, 9);
  model_.positions.emplace_back(0, 1, 9);
  surface_ = build_surface(model_);
  const auto parts = describe_parts(model_, surface_, {});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[1].role, PartRole::rest);
  EXPECT_EQ(parts[1].vertex_count, 2U);
}

TEST_F(CartoonHead, EmptyModel_HasNoParts) {
  const Model nothing;
  EXPECT_TRUE(describe_parts(nothing, build_surface(nothing), {}).empty());
}

TEST_F(CartoonHead, OneNameForAll_MaterialsTellThePartsApart) {
  const std::uint32_t ball = add(testing::make_ball({3, 4, -1.2F}, 1.3F), "head");
  ASSERT_GT(ball, 0U);
  model_.materials = {{.name = "skin"}, {.name = "Hair"}};
  model_.primitives[0].material = 0;
  model_.primitives.back().material = 1;
  surface_ = build_surface(model_);
  const auto parts = describe_parts(model_, surface_, {});
  EXPECT_EQ(parts[0].name, "skin");
  EXPECT_EQ(parts[1].name, "Hair");
  EXPECT_EQ(parts[1].role, PartRole::rest);  // by its place it would be an eye
}

TEST_F(CartoonHead, HairInOnePiece_IsNotAttachedHoweverCloseItLies) {
  add(testing::make_box({-8, 6, 0.1F}, {8, 11, 0.6F}), "");
  surface_ = build_surface(model_);
  EXPECT_EQ(describe_parts(model_, surface_, face_points())[1].role, PartRole::rest);
}

struct NameCase {
  const char* name;
  double x;
  std::optional<PartRole> role;
};

TEST(RoleByName, NamesInUse_SayWhatTheySay) {
  for (const auto& [name, x, role] : std::vector<NameCase>{{"EyeLeft", 3, PartRole::left_eye},
                                                           {"eye.R", 3, PartRole::right_eye},
                                                           {"l_eye", 3, PartRole::left_eye},
                                                           {"Eyeball", -3, PartRole::right_eye},
                                                           {"M_EyeLashes", 3, PartRole::attached},
                                                           {"eyebrow_left", 3, PartRole::attached},
                                                           {"EyeOcclusion", 3, PartRole::attached},
                                                           {"glasses", 0, PartRole::rest},
                                                           {"Eyeglasses", 0, PartRole::rest},
                                                           {"Wolf3D_Hair", 0, PartRole::rest},
                                                           {"teeth-upper", 0, PartRole::upper_teeth},
                                                           {"Gums_Lower", 0, PartRole::lower_teeth},
                                                           {"Wolf3D_Teeth", 0, std::nullopt},
                                                           {"Tongue", 0, PartRole::tongue},
                                                           {"GumsTongue", 0, PartRole::tongue},
                                                           {"Wolf3D_Head", 0, std::nullopt},
                                                           {"Material.001", 0, std::nullopt},
                                                           {"", 0, std::nullopt}}) {
    std::vector<PartShape> shapes(2);
    shapes[0].low.x = -10;
    shapes[0].high.x = 10;
    shapes[1].name = name;
    shapes[1].center.x = x;
    shapes[1].triangles = 1;
    std::vector<std::optional<PartRole>> roles = {PartRole::skin, std::nullopt};
    guess_roles_by_name(shapes, roles);
    EXPECT_EQ(roles[1], role) << name;
  }
}

}  // namespace
}  // namespace semblante

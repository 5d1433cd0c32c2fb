#include "clients/native/render/scene.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/unit/render/ball.h"

namespace semblante::testing {
namespace {

using render::build_scene;
using render::Substance;

TEST(Scene, InvalidModels_AreRefusedByName) {
  EXPECT_EQ(build_scene(Model{}).error().code, ErrorCode::empty);
  {
    Model model = seamed_ball();
    model.positions[3].y = std::numeric_limits<float>::infinity();
    EXPECT_EQ(build_scene(model).error().code, ErrorCode::not_finite);
  }
  {
    Model model = seamed_ball();
    model.triangles[0][1] = static_cast<std::uint32_t>(model.positions.size());
    EXPECT_EQ(build_scene(model).error().where, "triangles");
  }
  {
    Model model = seamed_ball();
    model.primitives[0].triangle_count += 1;
    EXPECT_EQ(build_scene(model).error().where, "primitives");
  }
  {
    Model model = seamed_ball();
    model.uv_triangles.pop_back();
    EXPECT_EQ(build_scene(model).error().where, "uv_triangles");
  }
  {
    Model model = seamed_ball();
    model.colors.resize(3);
    EXPECT_EQ(build_scene(model).error().where, "colors");
  }
}

TEST(Scene, BrokenImage_IsLeftOutWithAWarning) {
  Model model = seamed_ball();
  model.images.push_back({"image/png", {1, 2, 3}});
  model.materials.emplace_back();
  model.materials[0].base_color_image = 0;
  model.primitives[0].material = 0;
  const auto scene = build_scene(model);
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->runs[0].texture, -1);
  EXPECT_EQ(scene->warnings.size(), 1U);
}

TEST(SmoothNormals, OverASeam_AreTheSameOnBothSides) {
  const Model model = seamed_ball();
  const auto scene = build_scene(model);
  ASSERT_TRUE(scene);
  std::vector<glm::vec3> positions;
  std::vector<std::size_t> drawn_of(model.positions.size());
  for (const std::uint32_t v : scene->file_vertex) {
    drawn_of[v] = positions.size();
    positions.push_back(model.positions[v]);
  }
  const std::vector<glm::vec3> normals = scene->normals.compute(positions);
  for (std::size_t r = 0; r < normals.size(); ++r) {
    // A ball's normal is its position; a coarse one is a little off.
    EXPECT_GT(glm::dot(normals[r], positions[r]), 0.99F) << r;
    EXPECT_NEAR(glm::length(normals[r]), 1.0F, 1e-5F);
  }
  for (std::size_t ring = 0; ring <= 16; ++ring) {
    EXPECT_EQ(normals[drawn_of[ring * 25]], normals[drawn_of[ring * 25 + 24]]) << ring;
  }
}

TEST(SmoothNormals, OfTheFile_AreKeptAtRestAndTurnWithTheSurface) {
  const std::vector<glm::vec3> rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const glm::vec3 own = glm::normalize(glm::vec3(0.3F, 0.2F, 1.0F));
  const render::SmoothNormals normals(rest, {own, 2.0F * own, glm::vec3(0.0F)}, std::vector<Triangle>{{0, 1, 2}},
                                      std::vector<std::uint8_t>{0});
  const auto are_near = [](const glm::vec3& found, const glm::vec3& expected) {
    EXPECT_LT(glm::distance(found, expected), 1e-6F);
  };
  const std::vector<glm::vec3> neutral = normals.compute(rest);
  are_near(neutral[0], own);
  are_near(neutral[1], own);
  are_near(neutral[2], {0, 0, 1});
  // By a quarter turn about x: (x, y, z) -> (x, -z, y).
  const std::vector<glm::vec3> turned = normals.compute(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}});
  are_near(turned[0], {own.x, -own.z, own.y});
  are_near(turned[2], {0, -1, 0});
  // Turned over there is no smallest rotation.
  are_near(normals.compute(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}})[0], {0, 0, -1});
}

TEST(SmoothNormals, WithoutArea_AreStillUnit) {
  const std::vector<glm::vec3> positions(3, glm::vec3(1, 2, 3));
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  const std::vector<std::uint8_t> groups = {0};
  const render::SmoothNormals normals(positions, std::vector<glm::vec3>(3, glm::vec3(0.0F)), triangles, groups);
  for (const glm::vec3& normal : normals.compute(positions)) {
    EXPECT_EQ(normal, glm::vec3(0, 0, 1));
  }
}

TEST(Look, Names_TellTheSubstance) {
  EXPECT_EQ(render::substance_by_name("M_EyeLashes"), Substance::lashes);
  EXPECT_EQ(render::substance_by_name("M_ScleraLeft"), Substance::eyeball);
  EXPECT_EQ(render::substance_by_name("M_EyeOcclusion"), Substance::film);
  EXPECT_EQ(render::substance_by_name("GumsTongue"), Substance::gums);
  EXPECT_EQ(render::substance_by_name("teeth-upper"), Substance::teeth);
  EXPECT_EQ(render::substance_by_name("eye-left"), Substance::eyeball);
  EXPECT_EQ(render::substance_by_name("Object_7"), std::nullopt);
}

TEST(Look, MaterialWithAColour_KeepsIt) {
  Model model = seamed_ball();
  model.materials.emplace_back();
  model.materials[0].name = "eye";
  model.materials[0].base_color = {0.1F, 0.5F, 0.2F, 1.0F};
  model.primitives[0].material = 0;
  const render::Look look = render::look_of(model, model.primitives[0], PartRole::left_eye);
  EXPECT_EQ(look.color, glm::vec3(0.1F, 0.5F, 0.2F));
  EXPECT_EQ(look.substance, Substance::eyeball) << "the close-up of the eyes needs it";
}

TEST(Look, RoleOfANamelessPart_TellsTheSubstance) {
  Model model = seamed_ball();
  model.primitives[0].name = "";
  EXPECT_EQ(render::look_of(model, model.primitives[0], PartRole::upper_teeth).substance, Substance::teeth);
  EXPECT_EQ(render::look_of(model, model.primitives[0], std::nullopt).substance, Substance::skin);
  EXPECT_EQ(render::look_of(model, model.primitives[0], PartRole::attached).substance, Substance::hair);
}

TEST(Look, ClothWhoseTextureIsLost_IsNotSkin) {
  Model model = seamed_ball();
  model.primitives[0].name = "Wolf3D_Outfit_Top";
  Material cloth;
  cloth.name = "Wolf3D_Outfit_Top";
  cloth.base_color = {0.9F, 0.5F, 0.4F, 1.0F};  // a tint of the texture that is not there
  cloth.is_color_lost = true;
  model.materials = {cloth};
  model.primitives[0].material = 0;
  for (const PartRole role : {PartRole::rest, PartRole::body}) {
    const render::Look look = render::look_of(model, model.primitives[0], role);
    EXPECT_EQ(look.substance, Substance::plain);
    EXPECT_LT(look.color.r - look.color.b, 0.1F) << "neutral";
  }
}

}  // namespace
}  // namespace semblante::testing

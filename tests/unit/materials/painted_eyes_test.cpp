// Eyes of files without an iris get a painted one.
#include "core/materials/painted_eyes.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "core/materials/eye_texture.h"
#include "core/materials/materials.h"
#include "tests/support/meshes.h"

namespace semblante {
namespace {

constexpr int rings = 12;
constexpr int segments = 16;
constexpr float ball = 12.0F;

void add_ball(Model& model, const glm::vec3& center) {
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  const auto at = [&](int ring, int segment) {
    return first + static_cast<std::uint32_t>(ring * segments + segment % segments);
  };
  const float pi = std::acos(-1.0F);
  for (int ring = 0; ring <= rings; ++ring) {
    const float polar = pi * (static_cast<float>(ring) + 0.01F) / (static_cast<float>(rings) + 0.02F);
    for (int segment = 0; segment < segments; ++segment) {
      const float turn = 2.0F * pi * static_cast<float>(segment) / static_cast<float>(segments);
      model.positions.push_back(center + ball * glm::vec3(std::sin(polar) * std::cos(turn),
                                                          std::sin(polar) * std::sin(turn), std::cos(polar)));
    }
  }
  for (int ring = 0; ring < rings; ++ring) {
    for (int segment = 0; segment < segments; ++segment) {
      model.triangles.push_back({at(ring, segment), at(ring + 1, segment), at(ring + 1, segment + 1)});
      model.triangles.push_back({at(ring, segment), at(ring + 1, segment + 1), at(ring, segment + 1)});
    }
  }
}

/// Two eyeballs in one primitive, the left first.
struct Eyes {
  Model model;
  Surface surface;
  std::vector<Part> parts;
  EyeLook look;

  explicit Eyes(const glm::vec3& gaze = {0.0F, 0.0F, 1.0F}) {
    add_ball(model, {30.0F, 0.0F, 0.0F});
    add_ball(model, {-30.0F, 0.0F, 0.0F});
    model.primitives.push_back({"", -1, 0, static_cast<std::uint32_t>(model.triangles.size())});
    surface = build_surface(model);
    parts.resize(surface.part_count());
    for (std::size_t v = 0; v < model.positions.size(); ++v) {
      Part& part = parts[surface.part_of[surface.surface_of[v].value()].value()];
      part.role = model.positions[v].x > 0.0F ? PartRole::left_eye : PartRole::right_eye;
    }
    for (const std::size_t e : {0U, 1U})
      look.eyes[e] = PaintedEye{{e == 0 ? 30.0F : -30.0F, 0.0F, 0.0F}, glm::normalize(gaze), 6.0F};
  }

  void paint() { paint_eyes(model, surface, parts, look); }
};

struct Pixels {
  int width = 0, height = 0;
  std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> rgb{nullptr, &stbi_image_free};

  explicit Pixels(const Image& image) {
    int channels = 0;
    rgb.reset(
        stbi_load_from_memory(image.bytes.data(), static_cast<int>(image.bytes.size()), &width, &height, &channels, 3));
  }
  /// Mean of the channels at texture coordinates.
  [[nodiscard]] double at(const glm::vec2& uv) const {
    const int x = std::min(width - 1, static_cast<int>(uv.x * static_cast<float>(width)));
    const int y = std::min(height - 1, static_cast<int>(uv.y * static_cast<float>(height)));
    const stbi_uc* const pixel = rgb.get() + 3 * (y * width + x);
    return (pixel[0] + pixel[1] + pixel[2]) / 3.0;
  }
};

/// What a viewer shows at places `r` from the axis of the left eye, in the triangles that cover them.
std::vector<double> brightness_at(const Eyes& eyes, float r, const glm::vec3& gaze) {
  const Pixels pixels(eyes.model.images.back());
  const glm::vec3 axis = glm::normalize(gaze);
  const glm::vec3 left = glm::normalize(glm::cross(glm::vec3(0.0F, 1.0F, 0.0F), axis));
  const glm::vec3 up = glm::cross(axis, left);
  std::vector<double> seen;
  for (int k = 0; k < 48; ++k) {
    const float turn = 0.1309F * static_cast<float>(k) + 0.05F;
    const glm::vec2 at(r * std::cos(turn), r * std::sin(turn));
    for (std::size_t t = 0; t < eyes.model.triangles.size(); ++t) {
      std::array<glm::vec2, 3> flat;
      bool is_front = true;
      for (std::size_t c = 0; c < 3; ++c) {
        const glm::vec3 d = eyes.model.positions[eyes.model.triangles[t][c]] - glm::vec3(30.0F, 0.0F, 0.0F);
        flat[c] = {glm::dot(d, left), glm::dot(d, up)};
        is_front = is_front && glm::dot(d, axis) > 0.0F && glm::length(d) < 2.0F * ball;
      }
      if (!is_front) continue;
      const auto cross = [](const glm::vec2& a, const glm::vec2& b) { return a.x * b.y - a.y * b.x; };
      const float area = cross(flat[1] - flat[0], flat[2] - flat[0]);
      const float b = cross(at - flat[0], flat[2] - flat[0]) / area;
      const float c = cross(flat[1] - flat[0], at - flat[0]) / area;
      if (b < 0.0F || c < 0.0F || b + c > 1.0F) continue;
      const auto& corners = eyes.model.uv_triangles[t];
      seen.push_back(pixels.at((1.0F - b - c) * eyes.model.uvs[corners[0]] + b * eyes.model.uvs[corners[1]] +
                               c * eyes.model.uvs[corners[2]]));
      break;
    }
  }
  return seen;
}

TEST(PaintEyes, ColorsOfVertices_AreALookOfTheirOwn) {
  Eyes eyes;
  eyes.model.colors.assign(eyes.model.positions.size(), {90, 120, 160});
  eyes.model.primitives[0].has_colors = true;
  eyes.paint();
  EXPECT_TRUE(eyes.model.materials.empty());
}

TEST(PaintedEyes, PupilAndIris_AreRound_OnACoarseBall_AroundTheGaze) {
  for (const glm::vec3& gaze : {glm::vec3(0.0F, 0.0F, 1.0F), glm::vec3(0.2F, -0.1F, 1.0F)}) {
    Eyes eyes(gaze);
    eyes.paint();
    for (const float pupil : {0.2F, 1.6F}) {
      const auto seen = brightness_at(eyes, pupil, gaze);
      ASSERT_GT(seen.size(), 40U);
      for (const double value : seen) EXPECT_LT(value, 40.0) << pupil;
    }
    for (const double value : brightness_at(eyes, 3.5F, gaze)) {
      EXPECT_GT(value, 60.0);
      EXPECT_LT(value, 160.0);
    }
    for (const double value : brightness_at(eyes, 6.9F, gaze)) EXPECT_GT(value, 220.0);
  }
}

/// Diamonds of four triangles about the pupils, 12 behind which are the pivots.
Eyes flat_eyes(float half_width, float half_height) {
  Eyes eyes;
  Model discs;
  for (const float x : {30.0F, -30.0F}) {
    const auto first = static_cast<std::uint32_t>(discs.positions.size());
    for (const glm::vec2& at :
         {glm::vec2(0.0F), {half_width, 0.0F}, {0.0F, half_height}, {-half_width, 0.0F}, {0.0F, -half_height}})
      discs.positions.emplace_back(x + at.x, at.y, ball);
    for (std::uint32_t k = 0; k < 4; ++k) discs.triangles.push_back({first, first + 1 + k, first + 1 + (k + 1) % 4});
  }
  discs.primitives.push_back({"", -1, 0, static_cast<std::uint32_t>(discs.triangles.size())});
  eyes.model = discs;
  eyes.surface = build_surface(eyes.model);
  eyes.parts.resize(eyes.surface.part_count());
  eyes.parts[0].role = PartRole::left_eye;
  eyes.parts[1].role = PartRole::right_eye;
  eyes.paint();
  return eyes;
}

// An eye of a game's character: a pyramid whose base is behind the pivot, so that each of its front triangles is too.
TEST(PaintedEyes, OnABallOfFewTriangles_TheIrisIsWhole) {
  Eyes eyes;
  eyes.model = {};
  for (const float side : {30.0F, -30.0F}) {
    const auto first = static_cast<std::uint32_t>(eyes.model.positions.size());
    for (const glm::vec3& p :
         {glm::vec3(2.0F, 1.0F, 12.0F), glm::vec3(12.0F, -12.0F, -1.0F), glm::vec3(12.0F, 12.0F, -1.0F),
          glm::vec3(-12.0F, 12.0F, -1.0F), glm::vec3(-12.0F, -12.0F, -1.0F), glm::vec3(0.0F, 0.0F, -12.0F)})
      eyes.model.positions.push_back(p + glm::vec3(side, 0.0F, 0.0F));
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t a = first + 1 + k;
      const std::uint32_t b = first + 1 + (k + 1) % 4;
      eyes.model.triangles.push_back({first, a, b});
      eyes.model.triangles.push_back({first + 5, b, a});
    }
  }
  eyes.model.primitives.push_back({"", -1, 0, static_cast<std::uint32_t>(eyes.model.triangles.size())});
  eyes.surface = build_surface(eyes.model);
  eyes.parts.assign(eyes.surface.part_count(), {});
  eyes.parts[eyes.surface.part_of[0].value()].role = PartRole::left_eye;
  eyes.parts[eyes.surface.part_of[6].value()].role = PartRole::right_eye;
  eyes.paint();
  const Pixels pixels(eyes.model.images.back());
  ASSERT_EQ(eyes.model.uv_triangles.size(), 16U);
  for (std::size_t t = 0; t < 8; t += 2) {
    // The middle of the edge from the tip to a corner, at 8 or 9 of 17 from the axis, and the tip, which is on the
    // iris.
    const auto uv = [&](std::size_t c) { return eyes.model.uvs[eyes.model.uv_triangles[t][c]]; };
    EXPECT_LT(pixels.at(uv(0)), 160.0) << t;
    EXPECT_GT(pixels.at(0.4F * uv(0) + 0.6F * uv(1)), 180.0) << t;
    // The back shows none of it.
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_GT(pixels.at(eyes.model.uvs[eyes.model.uv_triangles[t + 1][c]]), 180.0) << t;
  }
}

TEST(PaintedEyes, AFlatDiscAboutThePupil_IsAllIris) {
  // The lids of the second one are half closed: by them the iris has a radius of 6.
  for (const float half : {7.0F, 11.0F}) {
    const Eyes eyes = flat_eyes(half, half);
    for (const float r : {3.5F, 4.9F}) {
      const auto seen = brightness_at(eyes, r, {0.0F, 0.0F, 1.0F});
      ASSERT_GT(seen.size(), 40U);
      for (const double value : seen) EXPECT_LT(value, 170.0) << r;
    }
    const Pixels pixels(eyes.model.images.back());
    const glm::vec2 near_corner(0.5F + 0.5F * 0.94F / 1.02F, 0.5F);
    EXPECT_LT(pixels.at(near_corner), 170.0) << half;
  }
}

TEST(PaintedEyes, AFlatEyeThatIsWiderThanHigh_HasWhiteBesideTheIris) {
  const Eyes eyes = flat_eyes(11.0F, 7.0F);
  const Pixels pixels(eyes.model.images.back());
  double brightest = 0.0;
  for (const glm::vec2& uv : eyes.model.uvs) brightest = std::max(brightest, pixels.at(uv));
  EXPECT_GT(brightest, 220.0);
}

TEST(PaintedEyes, TheBackIsWhite) {
  Eyes eyes;
  eyes.paint();
  const Pixels pixels(eyes.model.images.back());
  for (std::size_t t = 0; t < eyes.model.triangles.size(); ++t) {
    bool is_behind = true;
    for (const std::uint32_t v : eyes.model.triangles[t]) is_behind = is_behind && eyes.model.positions[v].z <= 0.0F;
    if (!is_behind) continue;
    glm::vec2 middle(0.0F);
    for (const std::uint32_t uv : eyes.model.uv_triangles[t]) middle += eyes.model.uvs[uv] / 3.0F;
    EXPECT_GT(pixels.at(middle), 220.0);
  }
}

/// A wall of some thickness, joined at its pupil: what is seen through the hole is dark, in either order of the
/// corners.
TEST(PaintedEyes, TheInsideOfAnEyeWithAHole_IsBlack) {
  for (const bool is_reversed : {false, true}) {
    Eyes eyes;
    Model& model = eyes.model;
    const std::size_t half = model.positions.size() / 2;
    // The second ball becomes the inner wall of the first; its triangles face the pivot.
    for (std::size_t v = 0; v < half; ++v)
      model.positions[half + v] =
          glm::vec3(30.0F, 0.0F, 0.0F) + 0.9F * (model.positions[v] - glm::vec3(30.0F, 0.0F, 0.0F));
    const std::size_t outer = model.triangles.size() / 2;
    for (std::size_t t = 0; t < 2 * outer; ++t)
      if ((t >= outer) != is_reversed) std::swap(model.triangles[t][1], model.triangles[t][2]);
    const auto n = static_cast<std::uint32_t>(half);
    for (std::uint32_t s = 0; s < segments; ++s) {
      const std::uint32_t next = (s + 1) % segments;
      model.triangles.push_back({s, next, n + s});
      model.triangles.push_back({next, n + next, n + s});
    }
    model.primitives[0].triangle_count = static_cast<std::uint32_t>(model.triangles.size());
    eyes.surface = build_surface(model);
    ASSERT_EQ(eyes.surface.part_count(), 1U);
    eyes.parts.assign(1, eyes.parts[0]);
    eyes.paint();
    const Pixels pixels(model.images.back());
    for (std::size_t t = outer; t < 2 * outer; ++t) {
      for (const std::uint32_t uv : model.uv_triangles[t]) ASSERT_LT(pixels.at(model.uvs[uv]), 40.0) << t;
    }
    EXPECT_GT(pixels.at(model.uvs[model.uv_triangles[outer - 1][0]]), 220.0) << "the back, from outside";
  }
}

TEST(PaintedEyes, SingleTrianglesInTheWrongOrder_AreNoInside) {
  Eyes eyes;
  for (std::size_t t = 0; t < eyes.model.triangles.size(); t += 3)
    std::swap(eyes.model.triangles[t][1], eyes.model.triangles[t][2]);
  eyes.paint();
  for (const double value : brightness_at(eyes, 6.9F, {0.0F, 0.0F, 1.0F})) EXPECT_GT(value, 220.0);
}

TEST(PaintedEyes, Primitives_StillCoverAllTrianglesInOrder_AndTheTextureIsSmall) {
  Eyes eyes;
  eyes.paint();
  std::uint32_t next = 0;
  for (const Primitive& primitive : eyes.model.primitives) {
    EXPECT_EQ(primitive.first_triangle, next);
    next += primitive.triangle_count;
  }
  EXPECT_EQ(next, eyes.model.triangles.size());
  const auto assigned = assign_materials(eyes.model, eyes.surface, eyes.parts);
  ASSERT_EQ(assigned.materials.size(), 1U);
  EXPECT_EQ(assigned.materials[0].name, "eye");
  EXPECT_LE(eyes.model.images.back().bytes.size(), 48U * 1024U);
}

TEST(PaintedEyes, EyesOfTheFile_StayAsTheyAre) {
  const auto paints = [](const char* name, const glm::vec4& color, int image) {
    Eyes eyes;
    Material material;
    material.name = name;
    material.base_color = color;
    material.base_color_image = image;
    eyes.model.materials.push_back(material);
    if (image >= 0) eyes.model.images.emplace_back();
    eyes.model.primitives[0].material = 0;
    eyes.paint();
    return eyes.model.materials.size() > 1;
  };
  EXPECT_TRUE(paints("Eyes", glm::vec4(1.0F), -1));
  EXPECT_TRUE(paints("Eyes", {0.9F, 0.88F, 0.85F, 1.0F}, -1)) << "the white of an eye";
  EXPECT_FALSE(paints("Eyes", glm::vec4(1.0F), 0)) << "a texture";
  EXPECT_FALSE(paints("Eyes", {0.2F, 0.1F, 0.05F, 1.0F}, -1)) << "a colour";
}

TEST(PaintedEyes, AnIrisOfTheFile_BesideAWhite_IsEnough) {
  Eyes eyes;
  Material brown;
  brown.base_color = {0.2F, 0.1F, 0.05F, 1.0F};
  eyes.model.materials = {brown};
  // The first rings of the left eye are its iris; the right eye has none.
  Primitive iris = eyes.model.primitives[0];
  iris.material = 0;
  iris.triangle_count = 2 * segments;
  Primitive white = eyes.model.primitives[0];
  white.first_triangle = iris.triangle_count;
  white.triangle_count -= iris.triangle_count;
  eyes.model.primitives = {iris, white};
  eyes.paint();
  const std::uint32_t of_one = static_cast<std::uint32_t>(eyes.model.triangles.size()) / 2;
  for (const Primitive& primitive : eyes.model.primitives)
    EXPECT_EQ(primitive.material > 0, primitive.first_triangle >= of_one) << primitive.first_triangle;
}

/// The right ball as a shell around the left one, of which what is near the axis moves as its iris.
Eyes eye_in_a_shell(std::vector<RigidMotion>& motion) {
  Eyes eyes;
  const std::size_t half = eyes.model.positions.size() / 2;
  motion.assign(2 * half, RigidMotion::left_eye);
  for (std::size_t v = 0; v < half; ++v) {
    const glm::vec3 d = eyes.model.positions[v] - glm::vec3(30.0F, 0.0F, 0.0F);
    if (d.z > 0.0F && std::hypot(d.x, d.y) < 6.0F) motion[v] = RigidMotion::left_iris;
    eyes.model.positions[half + v] = glm::vec3(30.0F, 0.0F, 0.0F) + 1.1F * d;
  }
  for (Part& part : eyes.parts) part.role = PartRole::left_eye;
  eyes.look.motion = motion;
  return eyes;
}

TEST(PaintedEyes, ACorneaOverAnIris_HasARoundWindow) {
  std::vector<RigidMotion> motion;
  Eyes eyes = eye_in_a_shell(motion);
  eyes.paint();
  const auto assigned = assign_materials(eyes.model, eyes.surface, eyes.parts);
  const std::size_t half = eyes.model.triangles.size() / 2;
  for (std::size_t t = 0; t < 2 * half; ++t)
    ASSERT_EQ(assigned.materials[assigned.of_triangle[t]].name, t < half ? "eye" : "eye white") << t;
  const Material& white = assigned.materials[assigned.of_triangle[half]];
  EXPECT_EQ(white.alpha_mode, Material::AlphaMode::mask);
  const Image& image = eyes.model.images[static_cast<std::size_t>(white.base_color_image)];
  EXPECT_LE(image.bytes.size(), 8U * 1024U);
  int width = 0;
  int height = 0;
  int channels = 0;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> rgba(
      stbi_load_from_memory(image.bytes.data(), static_cast<int>(image.bytes.size()), &width, &height, &channels, 4),
      &stbi_image_free);
  ASSERT_TRUE(rgba);
  // The shell is 13.2 wide, the iris 6: the texture shows all of the shell.
  for (const auto& [radius, is_clear] : {std::pair{0.0, true}, {5.7, true}, {6.3, false}, {12.0, false}}) {
    for (int k = 0; k < 32; ++k) {
      const double reach = 0.5 * radius / (1.02 * 13.2);
      const int x = static_cast<int>((0.5 + reach * std::cos(0.2 * k)) * width);
      const int y = static_cast<int>((0.5 + reach * std::sin(0.2 * k)) * width);
      EXPECT_EQ(rgba.get()[4 * (y * width + x) + 3] < 128, is_clear) << radius;
    }
  }
}

TEST(PaintedEyes, ACorneaOverAnIrisOfTheFile_HasAWindowToo) {
  std::vector<RigidMotion> motion;
  Eyes eyes = eye_in_a_shell(motion);
  Material brown;
  brown.base_color = {0.2F, 0.1F, 0.05F, 1.0F};
  eyes.model.materials = {brown};
  Primitive ball = eyes.model.primitives[0];
  ball.material = 0;
  ball.triangle_count /= 2;
  Primitive shell = eyes.model.primitives[0];
  shell.first_triangle = ball.triangle_count;
  shell.triangle_count = ball.triangle_count;
  eyes.model.primitives = {ball, shell};
  eyes.paint();
  EXPECT_EQ(eyes.model.primitives[0].material, 0);
  ASSERT_GT(eyes.model.primitives[1].material, 0);
  EXPECT_EQ(eyes.model.materials[static_cast<std::size_t>(eyes.model.primitives[1].material)].name, "eye white");
}

TEST(PaintedEyes, ABallWhoseIrisHasATriangleThatDoesNotMove_IsNoCornea) {
  Eyes eyes;
  std::vector<RigidMotion> motion(eyes.model.positions.size(), RigidMotion::left_eye);
  for (std::size_t v = 0; v < segments; ++v) motion[v] = RigidMotion::left_iris;  // the second ring is within, too
  eyes.look.motion = motion;
  eyes.paint();
  const auto assigned = assign_materials(eyes.model, eyes.surface, eyes.parts);
  for (std::size_t t = 0; t < eyes.model.triangles.size() / 2; ++t)
    ASSERT_EQ(assigned.materials[assigned.of_triangle[t]].name, "eye") << t;
}

TEST(PaintedEyes, AHeadWithoutEyes_StaysAsItIs) {
  Eyes eyes;
  for (Part& part : eyes.parts) part.role = PartRole::skin;
  eyes.paint();
  EXPECT_TRUE(eyes.model.materials.empty());
  EXPECT_TRUE(eyes.model.images.empty());
  EXPECT_TRUE(eyes.model.uv_triangles.empty());
}

TEST(EyesOf, AnEyeWithoutAnIris_IsPaintedInTheSizeOfIrisd_ButNoLargerThanAChilds) {
  Rig rig;
  rig.points = {{testing::fp("3.5"), std::nullopt, {30.0F, 0.0F, 12.0F}}};
  rig.left_eye_pivot = {30.0F, 0.0F, 0.0F};
  rig.parts.resize(1);
  rig.parts[0].role = PartRole::left_eye;
  rig.parts[0].box_min = {18.0F, -12.0F, -12.0F};
  rig.parts[0].box_max = {42.0F, 12.0F, 12.0F};
  const auto radius_at = [&](double irisd0) {
    rig.fapu.value[static_cast<std::size_t>(FapuUnit::irisd)] = irisd0 / 1024.0;
    return eyes_of(rig).eyes[0].value().iris_radius;
  };
  EXPECT_FLOAT_EQ(radius_at(11.0), 5.5F);
  EXPECT_FLOAT_EQ(radius_at(20.0), 6.6F);  // 0.55 of 12
  rig.parts[0].box_min.z = 8.0F;           // a flat eye
  EXPECT_FLOAT_EQ(radius_at(20.0), 10.0F);
}

TEST(GuessedEyes, LookAhead_FromTheFrontOfTheirBalls) {
  std::vector<Part> parts(3);
  parts[0].role = PartRole::left_eye;
  parts[0].box_min = {18.0F, -12.0F, 0.0F};  // half a ball
  parts[0].box_max = {42.0F, 12.0F, 12.0F};
  const EyeLook look = guessed_eyes(parts);
  ASSERT_TRUE(look.eyes[0]);
  EXPECT_FALSE(look.eyes[1]);
  EXPECT_EQ(look.eyes[0]->pivot, glm::vec3(30.0F, 0.0F, 0.0F));
  EXPECT_EQ(look.eyes[0]->axis, glm::vec3(0.0F, 0.0F, 1.0F));
  EXPECT_NEAR(look.eyes[0]->iris_radius, 5.9F, 0.1F);
}

}  // namespace
}  // namespace semblante

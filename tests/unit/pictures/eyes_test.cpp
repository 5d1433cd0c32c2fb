// Pictures of painted eyes (core/materials/painted_eyes.h) by the native renderer.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

#include "clients/native/render/renderer.h"
#include "core/expressions/kernel_rig.h"
#include "core/materials/painted_eyes.h"
#include "core/parametrize/parametrize.h"
#include "tests/support/posed_face.h"

namespace semblante {
namespace {

constexpr int size = 400;
constexpr int directions = 64;
constexpr float degree = 3.14159265F / 180.0F;

/// A head of which only one eyeball is drawn, since lids would cover it.
class EyeAlone {
 public:
  EyeAlone(const bench::PosedFace& face, std::size_t eye) : face_(face), model_(face.head().model) {
    const EyeLook look = eyes_of(face_.rig());
    painted_ = look.eyes[eye].value();
    paint_eyes(model_, face.head().surface, face_.rig().parts, look);
    const PartRole role = eye == 0 ? PartRole::left_eye : PartRole::right_eye;
    std::vector<Primitive> kept;
    std::vector<Triangle> triangles;
    std::vector<Triangle> uvs;
    std::vector<Triangle> normals;
    for (const Primitive& primitive : model_.primitives) {
      Primitive run = primitive;
      run.first_triangle = static_cast<std::uint32_t>(triangles.size());
      for (std::uint32_t t = 0; t < primitive.triangle_count; ++t) {
        const std::size_t at = std::size_t{primitive.first_triangle} + t;
        if (face_.role_of(model_.triangles[at][0]) != role) continue;
        triangles.push_back(model_.triangles[at]);
        uvs.push_back(model_.uv_triangles[at]);
        if (!model_.normal_triangles.empty()) normals.push_back(model_.normal_triangles[at]);
      }
      run.triangle_count = static_cast<std::uint32_t>(triangles.size()) - run.first_triangle;
      if (run.triangle_count > 0) kept.push_back(run);
    }
    model_.primitives = kept;
    model_.triangles = triangles;
    model_.uv_triangles = uvs;
    model_.normal_triangles = normals;
    camera_.target = painted_.pivot;
    camera_.eye = painted_.pivot + glm::vec3(0.0F, 0.0F, 20.0F * painted_.iris_radius);
    camera_.near_plane = 5.0F * painted_.iris_radius;
    camera_.far_plane = 30.0F * painted_.iris_radius;
    camera_.vertical_field = 0.25F;
    auto scene = render::build_scene(model_);
    if (!scene) throw std::runtime_error(scene.error().message);
    auto renderer = render::Renderer::create(*std::move(scene));
    if (!renderer) throw std::runtime_error(renderer.error().message);
    renderer_.emplace(*std::move(renderer));
  }

  /// Looks down and to its left, radians.
  void look(float pitch, float yaw) {
    constexpr float units = 1e5F;
    moved_ =
        face_.pose(bench::frame_of({{23, yaw * units}, {24, yaw * units}, {25, pitch * units}, {26, pitch * units}}));
    turn_ = glm::angleAxis(yaw, glm::vec3(0.0F, 1.0F, 0.0F)) * glm::angleAxis(pitch, glm::vec3(1.0F, 0.0F, 0.0F));
  }

  render::Picture draw() {
    if (!renderer_->set_positions(moved_)) throw std::runtime_error("positions");
    auto picture = renderer_->draw(camera_, {size, size});
    if (!picture) throw std::runtime_error(picture.error().message);
    return *std::move(picture);
  }

  /// The pixel at which a line parallel to the gaze pierces the eyeball. The line is `radii` iris radii away from the
  /// gaze axis, in this direction around it (radians).
  [[nodiscard]] glm::vec2 pierced(float radii, float direction) const {
    const glm::vec3 left = glm::normalize(glm::cross(glm::vec3(0.0F, 1.0F, 0.0F), painted_.axis));
    const glm::vec3 up = glm::cross(painted_.axis, left);
    const float r = radii * painted_.iris_radius;
    const glm::vec3 axis = turn_ * painted_.axis;
    const glm::vec3 from = painted_.pivot + turn_ * (r * (std::cos(direction) * left + std::sin(direction) * up));
    float farthest = 0.0F;
    for (std::uint32_t at = 0; at < model_.triangles.size(); ++at) {
      if (!shows_the_iris(at)) continue;
      const Triangle& t = model_.triangles[at];
      const glm::vec3 a = moved_[t[0]];
      const glm::vec3 u = moved_[t[1]] - a;
      const glm::vec3 v = moved_[t[2]] - a;
      const glm::vec3 p = glm::cross(axis, v);
      const float det = glm::dot(u, p);
      if (std::abs(det) < 1e-12F) continue;
      const float b = glm::dot(from - a, p) / det;
      const glm::vec3 q = glm::cross(from - a, u);
      const float c = glm::dot(axis, q) / det;
      constexpr float at_an_edge = 1e-4F;
      if (b < -at_an_edge || c < -at_an_edge || b + c > 1.0F + at_an_edge) continue;
      farthest = std::max(farthest, glm::dot(v, q) / det);
    }
    const glm::vec4 clip = camera_.projection(1.0F) * camera_.view() * glm::vec4(from + farthest * axis, 1.0F);
    return {0.5F * size * (1.0F + clip.x / clip.w), 0.5F * size * (1.0F - clip.y / clip.w)};
  }

 private:
  [[nodiscard]] bool shows_the_iris(std::uint32_t triangle) const {
    return std::any_of(model_.primitives.begin(), model_.primitives.end(), [&](const Primitive& primitive) {
      return triangle >= primitive.first_triangle && triangle - primitive.first_triangle < primitive.triangle_count &&
             model_.materials[static_cast<std::size_t>(primitive.material)].name == "eye";
    });
  }

  const bench::PosedFace& face_;
  Model model_;
  PaintedEye painted_;
  render::Camera camera_;
  std::optional<render::Renderer> renderer_;
  std::vector<glm::vec3> moved_;
  glm::quat turn_{1.0F, 0.0F, 0.0F, 0.0F};
};

float brightness(const render::Picture& picture, glm::vec2 at) {
  const int x = std::clamp(static_cast<int>(at.x), 0, size - 1);
  const int y = std::clamp(static_cast<int>(at.y), 0, size - 1);
  const std::size_t i = 3 * (static_cast<std::size_t>(y) * size + static_cast<std::size_t>(x));
  return static_cast<float>(picture.rgb[i] + picture.rgb[i + 1] + picture.rgb[i + 2]) / 3.0F;
}

/// A rim of the picture against where it should be.
struct Rim {
  glm::vec2 off{0.0F};    ///< its centre from where the gaze pierces the eye, in radii of the iris
  std::size_t round = 0;  ///< directions in which it is within `tolerance` of its radius
};
constexpr float tolerance = 0.06F;

/// The rim at `radii` of the iris, between a darker and a brighter place.
Rim rim_of(const EyeAlone& eye, const render::Picture& picture, float radii, float inside, float outside) {
  const glm::vec2 centre = eye.pierced(0.0F, 0.0F);
  Rim rim;
  glm::vec2 sum(0.0F);
  float scale = 0.0F;
  for (int k = 0; k < directions; ++k) {
    const float direction = 360.0F * degree * static_cast<float>(k) / directions;
    const glm::vec2 expected = eye.pierced(radii, direction);
    const float dark = brightness(picture, eye.pierced(inside, direction));
    const float bright = brightness(picture, eye.pierced(outside, direction));
    float seen = inside;
    while (seen < outside && brightness(picture, eye.pierced(seen, direction)) < 0.5F * (dark + bright)) seen += 0.005F;
    if (bright > dark + 15.0F && std::abs(seen - radii) <= tolerance) ++rim.round;
    sum += eye.pierced(seen, direction) - expected;
    scale += glm::distance(eye.pierced(1.0F, direction), centre);
  }
  rim.off = sum / scale;
  return rim;
}

class PaintedGaze : public ::testing::TestWithParam<std::string> {};

/// The sample head whose eyes have a cornea: a second surface over the front of the ball.
bench::Head with_corneas() {
  bench::Head head = bench::sample_head();
  head.name = "sample head with corneas";
  Model& model = head.model;
  for (const char* const pupil : {"3.5", "3.6"}) {
    const FeaturePoint* const point = find_point(head.points, pupil);
    const PartId part = head.surface.part_of[head.surface.surface_of[point->vertex->value()].value()];
    glm::vec3 low(std::numeric_limits<float>::infinity());
    glm::vec3 high = -low;
    std::vector<Triangle> ball;
    for (const Triangle& t : model.triangles) {
      if (t[0] < head.surface.surface_of.size() &&
          head.surface.part_of[head.surface.surface_of[t[0]].value()] == part) {
        ball.push_back(t);
      }
    }
    for (const Triangle& t : ball) {
      for (const std::uint32_t v : t) {
        low = glm::min(low, model.positions[v]);
        high = glm::max(high, model.positions[v]);
      }
    }
    const glm::vec3 pivot = 0.5F * (low + high);
    const float reach = 0.45F * (high.x - low.x);  // a little less than the ball, and more than the iris
    const auto first = static_cast<std::uint32_t>(model.triangles.size());
    std::map<std::uint32_t, std::uint32_t> copies;
    for (Triangle t : ball) {
      const bool is_near = std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
        return model.positions[v].z > pivot.z && glm::length(glm::vec2(model.positions[v] - pivot)) < reach;
      });
      if (!is_near) continue;
      for (std::uint32_t& v : t) {
        const auto [copy, is_new] = copies.try_emplace(v, static_cast<std::uint32_t>(model.positions.size()));
        const glm::vec3 from_pivot = model.positions[v] - pivot;
        if (is_new) model.positions.push_back(pivot + 1.04F * from_pivot);
        v = copy->second;
      }
      model.triangles.push_back(t);
    }
    model.primitives.push_back({pupil == std::string("3.5") ? "left eye outer" : "right eye outer", -1, first,
                                static_cast<std::uint32_t>(model.triangles.size()) - first});
  }
  head.surface = build_surface(model);
  return head;
}

std::optional<bench::Head> head_named(const std::string& name) {
  if (name == "sample head with corneas") return with_corneas();
  std::vector<bench::Head> heads = bench::known_heads();
  for (bench::Head& head : heads) {
    if (head.name == name) return std::move(head);
  }
  return std::nullopt;
}

std::vector<std::string> names() { return {"sample head", "sample head with corneas", "ict-facekit", "makehuman"}; }

TEST_P(PaintedGaze, IrisAndPupil_AreRoundAboutThePlaceWhereTheGazePiercesTheEye) {
  const std::optional<bench::Head> head = head_named(GetParam());
  if (!head) GTEST_SKIP() << "the folder of real heads is not there";
  // Its iris lies deep behind a cornea, which hides a part of the rim from the side, and has a hole for the pupil that
  // is not on the axis of the eye.
  const bool is_deep = GetParam() == "ict-facekit";
  const bench::PosedFace face(*head, WeightMethod::smooth);
  for (const std::size_t side : {0U, 1U}) {
    EyeAlone eye(face, side);
    for (const auto& [pitch, yaw] :
         {std::pair{0.0F, 0.0F}, {-20.0F, -20.0F}, {-20.0F, 20.0F}, {20.0F, -20.0F}, {20.0F, 20.0F}}) {
      eye.look(pitch * degree, yaw * degree);
      const render::Picture picture = eye.draw();
      const std::string words =
          std::to_string(side) + " pitch " + std::to_string(pitch) + " yaw " + std::to_string(yaw);
      const Rim iris = rim_of(eye, picture, 1.0F, 0.85F, 1.2F);
      EXPECT_GE(iris.round, is_deep ? directions - 8 : directions) << words;
      EXPECT_LE(glm::length(iris.off), 0.03F) << words;
      if (is_deep) continue;
      const Rim pupil = rim_of(eye, picture, pupil_of_iris, 0.1F, 0.6F);
      EXPECT_GE(pupil.round, directions) << words;
      EXPECT_LE(glm::length(pupil.off), 0.03F) << words;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Heads, PaintedGaze, ::testing::ValuesIn(names()), [](const auto& info) {
  std::string name = info.param;
  std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
  return name;
});

}  // namespace
}  // namespace semblante

#include "core/materials/materials.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <string>
#include <string_view>

#include <glm/geometric.hpp>

namespace semblante {
namespace {

constexpr std::size_t max_materials = 255;

/// The plain materials, in linear RGB.
enum class Plain : std::uint8_t { skin, sclera, iris, pupil, teeth, mouth, hair, lashes, fluid, neutral };

struct PlainMaterial {
  std::string_view name;
  glm::vec4 color;
  float roughness;
};

constexpr std::array<PlainMaterial, 10> plain_materials = {{
    {"skin", {0.72F, 0.46F, 0.35F, 1.0F}, 0.55F},
    {"sclera", {0.85F, 0.84F, 0.81F, 1.0F}, 0.15F},
    {"iris", {0.12F, 0.20F, 0.24F, 1.0F}, 0.15F},
    {"pupil", {0.01F, 0.01F, 0.01F, 1.0F}, 0.10F},
    {"teeth", {0.84F, 0.80F, 0.72F, 1.0F}, 0.30F},
    {"mouth", {0.48F, 0.13F, 0.12F, 1.0F}, 0.40F},
    {"hair", {0.035F, 0.022F, 0.016F, 1.0F}, 0.70F},
    {"lashes", {0.035F, 0.022F, 0.016F, 0.35F}, 0.70F},  // strips of untextured hairs: translucent, not opaque
    {"fluid", {1.0F, 1.0F, 1.0F, 0.06F}, 0.05F},
    {"neutral", {0.30F, 0.31F, 0.33F, 1.0F}, 0.80F},  // clothing and whatever is no part of a face
}};

struct Hint {
  std::string_view word;
  Plain plain;
};

/// The first match is used: "lash" comes before "eye" because of "EyeLashes".
constexpr std::array<Hint, 16> hints = {{
    {"lash", Plain::lashes},
    {"eyeline", Plain::lashes},
    {"brow", Plain::hair},
    {"hair", Plain::hair},
    {"fluid", Plain::fluid},
    {"tear", Plain::fluid},
    {"occlusion", Plain::fluid},
    {"eyeblend", Plain::fluid},
    {"cornea", Plain::fluid},
    {"iris", Plain::iris},
    {"pupil", Plain::pupil},
    {"sclera", Plain::sclera},
    {"teeth", Plain::teeth},
    {"tooth", Plain::teeth},
    {"tongue", Plain::mouth},
    {"gum", Plain::mouth},
}};

Plain plain_of(std::string_view material, std::string_view primitive, PartRole role) {
  bool is_named_skin = false;
  for (const std::string_view name : {material, primitive}) {
    std::string lower(name);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
    // The mesh of a body may be called skin and have materials for clothing.
    if (!name.empty() && (material.empty() || name == material))
      is_named_skin = lower.find("skin") != std::string::npos;
    for (const Hint& hint : hints) {
      if (lower.find(hint.word) != std::string::npos) return hint.plain;
    }
  }
  switch (role) {
    case PartRole::left_eye:
    case PartRole::right_eye:
      return Plain::sclera;
    case PartRole::upper_teeth:
    case PartRole::lower_teeth:
      return Plain::teeth;
    case PartRole::tongue:
      return Plain::mouth;
    case PartRole::attached:
      return Plain::hair;
    case PartRole::skin:
      return Plain::skin;
    default:
      return is_named_skin ? Plain::skin : Plain::neutral;  // cloth must not look like skin
  }
}

/// The material of a triangle of a plain eyeball. The pupil's diameter is a third of the iris's, as in the neutral
/// face.
Plain painted(const glm::vec3& center, const Triangle& corners, Plain plain, PartRole role, const EyeLook& eyes) {
  const std::size_t eye = role == PartRole::left_eye ? 0 : 1;
  if (const std::optional<Iris>& iris = eyes.irises[eye]) {
    const glm::vec3 d = center - eyes.pivots[eye];
    const float along = glm::dot(d, iris->axis);
    const float radius = glm::length(d - along * iris->axis);
    if (along <= 0.0F || radius >= iris->iris_radius) return plain;
    const bool of_iris = std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
      return eyes.motion[v] == RigidMotion::left_iris || eyes.motion[v] == RigidMotion::right_iris;
    });
    if (!of_iris) return Plain::fluid;  // the cornea
    return radius < iris->pupil_radius ? Plain::pupil : Plain::iris;
  }
  const std::optional<glm::vec3>& pupil = eyes.pupils[eye];
  if (plain != Plain::sclera || !pupil) return plain;
  const float distance = glm::distance(center, *pupil);
  if (distance < eyes.iris_diameter / 6.0F) return Plain::pupil;
  return distance < eyes.iris_diameter / 2.0F ? Plain::iris : Plain::sclera;
}

bool says_nothing(const Material& material) {
  return material.is_color_lost || (material.base_color_image < 0 && glm::vec3(material.base_color) == glm::vec3(1.0F));
}

EyeLook eye_look(const Rig& rig) {
  static const std::array<FeaturePointId, 2> pupils = {*parse_feature_point("3.5"), *parse_feature_point("3.6")};
  EyeLook look;
  for (const FeaturePoint& point : rig.points) {
    for (std::size_t eye = 0; eye < pupils.size(); ++eye) {
      if (point.id == pupils[eye]) look.pupils[eye] = point.position;
    }
  }
  // The neutral face has its lids tangent to the iris, so the unit of the eyes is the diameter of the iris.
  look.iris_diameter = static_cast<float>(rig.fapu[FapuUnit::irisd].value_or(0.0) * 1024.0);
  look.irises = rig.irises;
  look.pivots = {rig.left_eye_pivot, rig.right_eye_pivot};
  look.motion = rig.rigid_of_vertex;
  return look;
}

}  // namespace

MaterialAssignment assign_materials(const Model& model, const Surface& surface, std::span<const Part> parts,
                                    const EyeLook& eyes) {
  MaterialAssignment out;
  out.of_triangle.resize(model.triangles.size());
  // Numbered in order of first use, so that unused materials are omitted. Negative keys are the plain materials.
  std::map<int, std::uint8_t> number_of;
  const auto number_for = [&](int key, const Material& material) {
    const auto known = number_of.find(key);
    if (known != number_of.end()) return known->second;
    if (out.materials.size() < max_materials) out.materials.push_back(material);
    return number_of[key] = static_cast<std::uint8_t>(out.materials.size() - 1);
  };
  for (const Primitive& primitive : model.primitives) {
    const bool named = primitive.material >= 0 && static_cast<std::size_t>(primitive.material) < model.materials.size();
    const Material* const own = named ? &model.materials[static_cast<std::size_t>(primitive.material)] : nullptr;
    for (std::size_t t = primitive.first_triangle; t < std::size_t{primitive.first_triangle} + primitive.triangle_count;
         ++t) {
      if (own != nullptr && !says_nothing(*own)) {
        out.of_triangle[t] = number_for(primitive.material, *own);
        continue;
      }
      const PartId part = surface.part_of[surface.surface_of[model.triangles[t][0]].value()];
      const PartRole role = part.value() < parts.size() ? parts[part.value()].role : PartRole::skin;
      Plain plain = plain_of(own != nullptr ? std::string_view(own->name) : std::string_view(), primitive.name, role);
      if ((plain == Plain::sclera || plain == Plain::iris) &&
          (role == PartRole::left_eye || role == PartRole::right_eye)) {
        const Triangle& corners = model.triangles[t];
        const glm::vec3 sum = model.positions[corners[0]] + model.positions[corners[1]] + model.positions[corners[2]];
        plain = painted(sum / 3.0F, corners, plain, role, eyes);
      }
      const PlainMaterial& look = plain_materials[static_cast<std::size_t>(plain)];
      Material material;
      material.name = look.name;
      material.base_color = look.color;
      material.roughness = look.roughness;
      if (look.color.a < 1.0F) material.alpha_mode = Material::AlphaMode::blend;
      out.of_triangle[t] = number_for(-1 - static_cast<int>(plain), material);
    }
  }
  return out;
}

MaterialAssignment materials_of_rig(const Model& model, const Surface& surface, const Rig& rig) {
  return assign_materials(model, surface, rig.parts, eye_look(rig));
}

}  // namespace semblante

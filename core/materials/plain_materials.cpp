#include "core/materials/plain_materials.h"

#include <array>
#include <string>

#include "core/types/letter_case.h"

namespace semblante {
namespace {

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
    {"lashes", {0.035F, 0.022F, 0.016F, 0.35F}, 0.70F},  // strips that stand for single hairs: translucent
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

}  // namespace

Plain plain_of(std::string_view material, std::string_view primitive, PartRole role) {
  bool is_named_skin = false;
  for (const std::string_view name : {material, primitive}) {
    const std::string lower = lower_case(name);
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

Material plain_material(Plain plain) {
  const PlainMaterial& look = plain_materials[static_cast<std::size_t>(plain)];
  Material material;
  material.name = look.name;
  material.base_color = look.color;
  material.roughness = look.roughness;
  if (look.color.a < 1.0F) material.alpha_mode = Material::AlphaMode::blend;
  return material;
}

const Material* material_of(const Model& model, const Primitive& primitive) {
  const bool named = primitive.material >= 0 && static_cast<std::size_t>(primitive.material) < model.materials.size();
  return named ? &model.materials[static_cast<std::size_t>(primitive.material)] : nullptr;
}

bool says_nothing(const Material& material) {
  return material.is_color_lost || (material.base_color_image < 0 && glm::vec3(material.base_color) == glm::vec3(1.0F));
}

bool has_look(const Model& model, const Primitive& primitive) {
  const Material* const own = material_of(model, primitive);
  return primitive.has_colors || (own != nullptr && !says_nothing(*own));
}

}  // namespace semblante

#include "server/package/materials.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <string>
#include <string_view>

namespace semblante {
namespace {

constexpr std::size_t max_materials = 255;

/// The plain materials, in linear RGB.
enum class Plain : std::uint8_t { skin, sclera, iris, teeth, mouth, hair, fluid };

struct PlainMaterial {
  std::string_view name;
  glm::vec4 color;
  float roughness;
};

constexpr std::array<PlainMaterial, 7> plain_materials = {{
    {"skin", {0.72F, 0.46F, 0.35F, 1.0F}, 0.55F},
    {"sclera", {0.85F, 0.84F, 0.81F, 1.0F}, 0.15F},
    {"iris", {0.12F, 0.20F, 0.24F, 1.0F}, 0.15F},
    {"teeth", {0.84F, 0.80F, 0.72F, 1.0F}, 0.30F},
    {"mouth", {0.48F, 0.13F, 0.12F, 1.0F}, 0.40F},
    {"hair", {0.035F, 0.022F, 0.016F, 1.0F}, 0.70F},
    {"fluid", {1.0F, 1.0F, 1.0F, 0.06F}, 0.05F},
}};

struct Hint {
  std::string_view word;
  Plain plain;
};

/// First match wins: "EyeLashes" must meet "lash" before "eye" could.
constexpr std::array<Hint, 15> hints = {{
    {"lash", Plain::hair},
    {"brow", Plain::hair},
    {"hair", Plain::hair},
    {"fluid", Plain::fluid},
    {"tear", Plain::fluid},
    {"occlusion", Plain::fluid},
    {"eyeblend", Plain::fluid},
    {"cornea", Plain::fluid},
    {"iris", Plain::iris},
    {"pupil", Plain::iris},
    {"sclera", Plain::sclera},
    {"teeth", Plain::teeth},
    {"tooth", Plain::teeth},
    {"tongue", Plain::mouth},
    {"gum", Plain::mouth},
}};

Plain plain_of(std::string_view material, std::string_view primitive, PartRole role) {
  for (const std::string_view name : {material, primitive}) {
    std::string lower(name);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
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
    case PartRole::rest:
      break;
  }
  return Plain::skin;
}

bool says_nothing(const Material& material) {
  return material.base_color_image < 0 && glm::vec3(material.base_color) == glm::vec3(1.0F);
}

}  // namespace

MaterialAssignment assign_materials(const Model& model, const Surface& surface, std::span<const Part> parts) {
  MaterialAssignment out;
  out.of_triangle.resize(model.triangles.size());
  // Numbered in order of first use, so that unused materials cost nothing. Keys below zero are the plain ones.
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
      const Plain plain =
          plain_of(own != nullptr ? std::string_view(own->name) : std::string_view(), primitive.name, role);
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

}  // namespace semblante

#include "clients/native/render/look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/types/letter_case.h"

namespace semblante::render {
namespace {

struct Appearance {
  glm::vec3 color;  ///< linear
  float alpha;
  float roughness;
  float specular;
};

Appearance appearance_of(Substance substance) {
  switch (substance) {
    case Substance::plain:
      return {{0.55F, 0.54F, 0.52F}, 1.0F, 0.6F, 0.03F};
    case Substance::skin:
      return {{0.56F, 0.345F, 0.265F}, 1.0F, 0.5F, 0.030F};
    case Substance::eyeball:
      return {{0.78F, 0.75F, 0.72F}, 1.0F, 0.14F, 0.045F};
    case Substance::iris:
      return {{0.075F, 0.14F, 0.19F}, 1.0F, 0.14F, 0.045F};
    case Substance::teeth:
      return {{0.78F, 0.73F, 0.63F}, 1.0F, 0.25F, 0.045F};
    case Substance::gums:
      return {{0.46F, 0.13F, 0.13F}, 1.0F, 0.35F, 0.04F};
    case Substance::hair:
      return {{0.045F, 0.028F, 0.02F}, 1.0F, 0.7F, 0.03F};
    case Substance::lashes:  // strips that represent single hairs: most of the area behind a strip is visible
      return {{0.04F, 0.025F, 0.018F}, 0.3F, 0.8F, 0.02F};
    case Substance::film:
      return {{0.8F, 0.8F, 0.8F}, 0.0F, 0.1F, 0.03F};
  }
  return {{0.55F, 0.54F, 0.52F}, 1.0F, 0.6F, 0.03F};
}

Substance substance_by_role(PartRole role) {
  switch (role) {
    case PartRole::skin:
      return Substance::skin;
    case PartRole::left_eye:
    case PartRole::right_eye:
      return Substance::eyeball;
    case PartRole::upper_teeth:
    case PartRole::lower_teeth:
      return Substance::teeth;
    case PartRole::tongue:
      return Substance::gums;
    case PartRole::attached:
      return Substance::hair;
    case PartRole::rest:
    case PartRole::body:
      break;  // cloth must not look like skin
  }
  return Substance::plain;
}

/// White and greys are the defaults of files without chosen colours.
bool says_nothing(const Material& material) {
  const glm::vec4& c = material.base_color;
  const float spread = std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b});
  return material.is_color_lost || (material.base_color_image < 0 && spread < 0.02F && c.a > 0.99F && c.r > 0.3F);
}

}  // namespace

std::optional<Substance> substance_by_name(std::string_view name) {
  const std::string lower = lower_case(name);
  // In this order: "EyeLashes" is hair before it is an eye, "EyeOcclusion" a film, "GumsTongue" gums.
  static constexpr std::array<std::pair<std::string_view, Substance>, 24> words = {{
      {"occlusion", Substance::film},  {"lacrimal", Substance::film},  {"tear", Substance::film},
      {"eyeblend", Substance::film},   {"fluid", Substance::film},     {"cornea", Substance::film},
      {"lash", Substance::lashes},     {"brow", Substance::hair},      {"hair", Substance::hair},
      {"gum", Substance::gums},        {"tongue", Substance::gums},    {"mouth", Substance::gums},
      {"teeth", Substance::teeth},     {"tooth", Substance::teeth},    {"iris", Substance::iris},
      {"pupil", Substance::iris},      {"sclera", Substance::eyeball}, {"lid", Substance::skin},
      {"eyeball", Substance::eyeball}, {"eye", Substance::eyeball},    {"skin", Substance::skin},
      {"head", Substance::skin},       {"face", Substance::skin},      {"body", Substance::skin},
  }};
  for (const auto& [word, substance] : words) {
    if (lower.find(word) != std::string::npos) {
      return substance;
    }
  }
  return std::nullopt;
}

Look look_of(const Model& model, const Primitive& primitive, std::optional<PartRole> role) {
  const Material* material =
      primitive.material >= 0 ? &model.materials[static_cast<std::size_t>(primitive.material)] : nullptr;
  std::optional<Substance> substance = material != nullptr ? substance_by_name(material->name) : std::nullopt;
  if (!substance) {
    substance = substance_by_name(primitive.name);
  }
  if (!substance && role) {
    substance = substance_by_role(*role);
  }
  Look look;
  look.substance = substance.value_or(Substance::skin);
  const Appearance appearance = appearance_of(look.substance);
  look.color = appearance.color;
  look.alpha = appearance.alpha;
  look.roughness = appearance.roughness;
  look.specular = appearance.specular;
  if (material != nullptr && !says_nothing(*material)) {
    if (look.substance == Substance::film) look.substance = Substance::plain;
    look.color = glm::vec3(material->base_color);
    look.alpha = material->base_color.a;
    look.roughness = std::clamp(material->roughness, 0.08F, 1.0F);
    look.specular = 0.04F;
    look.image = material->base_color_image;
    look.alpha_mode = material->alpha_mode;
    look.alpha_cutoff = material->alpha_cutoff;
    if (look.alpha_mode == Material::AlphaMode::opaque) {
      look.alpha = 1.0F;
    }
  } else if (primitive.has_colors) {
    look.color = material != nullptr && !material->is_color_lost ? glm::vec3(material->base_color) : glm::vec3(1.0F);
  }
  return look;
}

}  // namespace semblante::render

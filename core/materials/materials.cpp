#include "core/materials/materials.h"

#include <map>
#include <string_view>

#include "core/materials/plain_materials.h"

namespace semblante {
namespace {

constexpr std::size_t max_materials = 255;
constexpr int plain_count = static_cast<int>(Plain::neutral) + 1;

/// Skin, teeth and eyes hide what lies behind them. A viewer does not sort the triangles of a blended material, so that
/// the back of the head would show through its face.
bool is_solid(const Material& material, Plain plain) {
  switch (plain) {
    case Plain::skin:
      return true;
    case Plain::sclera:
    case Plain::iris:
    case Plain::pupil:
    case Plain::teeth:
    case Plain::mouth:
      return material.base_color.a >= 1.0F;  // less than 1 is intended: a transparent film over an eye, for example
    default:
      return false;
  }
}

/// The material as a mask: its image cuts holes, and nothing is half transparent. Many exporters call every material
/// blended whose image has a channel of opacity, and some write the opacity of a material as its transparency.
Material solid(Material material) {
  material.alpha_mode = material.base_color_image < 0 ? Material::AlphaMode::opaque : Material::AlphaMode::mask;
  material.base_color.a = 1.0F;
  return material;
}

/// For vertices with colours of their own: the plain material, which tells viewers what kind of surface it is, in
/// white, which leaves the colours as they are.
Material colored(Plain plain) {
  Material material = plain_material(plain);
  material.base_color = glm::vec4(1.0F, 1.0F, 1.0F, material.base_color.a);
  return material;
}

}  // namespace

MaterialAssignment assign_materials(const Model& model, const Surface& surface, std::span<const Part> parts) {
  MaterialAssignment out;
  out.of_triangle.resize(model.triangles.size());
  // Numbered in order of first use, so that unused materials are omitted. Negative keys are the plain materials, first
  // those with a colour of their own; those from the number of the model's on its solid ones.
  std::map<int, std::uint8_t> number_of;
  const auto number_for = [&](int key, const Material& material) {
    const auto known = number_of.find(key);
    if (known != number_of.end()) return known->second;
    if (out.materials.size() < max_materials) out.materials.push_back(material);
    return number_of[key] = static_cast<std::uint8_t>(out.materials.size() - 1);
  };
  for (const Primitive& primitive : model.primitives) {
    const Material* const own = material_of(model, primitive);
    for (std::size_t t = primitive.first_triangle; t < std::size_t{primitive.first_triangle} + primitive.triangle_count;
         ++t) {
      const bool keeps_own = own != nullptr && !says_nothing(*own);
      const bool is_blended = keeps_own && own->alpha_mode == Material::AlphaMode::blend;
      if (keeps_own && (!is_blended || parts.empty())) {
        out.of_triangle[t] = number_for(primitive.material, *own);
        continue;
      }
      const PartId part = surface.part_of[surface.surface_of[model.triangles[t][0]].value()];
      const PartRole role = part.value() < parts.size() ? parts[part.value()].role : PartRole::skin;
      const Plain plain =
          plain_of(own != nullptr ? std::string_view(own->name) : std::string_view(), primitive.name, role);
      if (!keeps_own && primitive.has_colors)
        out.of_triangle[t] = number_for(-1 - plain_count - static_cast<int>(plain), colored(plain));
      else if (!keeps_own)
        out.of_triangle[t] = number_for(-1 - static_cast<int>(plain), plain_material(plain));
      else if (is_solid(*own, plain))
        out.of_triangle[t] = number_for(primitive.material + static_cast<int>(model.materials.size()), solid(*own));
      else
        out.of_triangle[t] = number_for(primitive.material, *own);
    }
  }
  return out;
}

}  // namespace semblante

#include "core/materials/materials.h"

#include <map>
#include <string_view>

#include "core/materials/plain_materials.h"

namespace semblante {
namespace {

constexpr std::size_t max_materials = 255;

}  // namespace

MaterialAssignment assign_materials(const Model& model, const Surface& surface, std::span<const Part> parts) {
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
    const Material* const own = material_of(model, primitive);
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
      out.of_triangle[t] = number_for(-1 - static_cast<int>(plain), plain_material(plain));
    }
  }
  return out;
}

}  // namespace semblante

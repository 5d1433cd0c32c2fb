#include "core/materials/painted_mouth.h"

#include <algorithm>
#include <utility>

#include "core/materials/painted_primitives.h"
#include "core/materials/plain_materials.h"

namespace semblante {
namespace {

bool is_plain_skin(const Model& model, const Primitive& primitive, PartRole role) {
  if (has_look(model, primitive)) return false;
  const Material* const own = material_of(model, primitive);
  return plain_of(own != nullptr ? std::string_view(own->name) : std::string_view(), primitive.name, role) ==
         Plain::skin;
}

}  // namespace

void paint_mouth(Model& model, const Surface& surface, std::span<const Part> parts, const std::vector<bool>& inside) {
  if (inside.empty()) return;
  const auto mouth = static_cast<int>(model.materials.size());
  bool is_any_painted = false;
  const auto paint_of = [&](const Primitive& primitive, std::uint32_t t) -> std::optional<int> {
    const Triangle& triangle = model.triangles[t];
    const bool lies_inside = std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t corner) {
      return inside[surface.surface_of[corner].value()];
    });
    if (!lies_inside) return std::nullopt;
    const Part& part = parts[surface.part_of[surface.surface_of[triangle[0]].value()].value()];
    if (!is_plain_skin(model, primitive, part.role)) return std::nullopt;
    is_any_painted = true;
    return mouth;
  };
  auto painted = painted_primitives(model, paint_of);
  if (!is_any_painted) return;
  model.materials.push_back(plain_material(Plain::mouth));
  model.primitives = std::move(painted);
}

}  // namespace semblante

#include "core/materials/painted_mouth.h"

#include <algorithm>
#include <utility>

#include "core/materials/plain_materials.h"

namespace semblante {
namespace {

bool is_plain_skin(const Model& model, const Primitive& primitive, PartRole role) {
  const Material* const own = material_of(model, primitive);
  if (own != nullptr && !says_nothing(*own)) return false;
  return plain_of(own != nullptr ? std::string_view(own->name) : std::string_view(), primitive.name, role) ==
         Plain::skin;
}

}  // namespace

void paint_mouth(Model& model, const Surface& surface, std::span<const Part> parts, const std::vector<bool>& inside) {
  if (inside.empty()) return;
  const auto is_painted = [&](const Primitive& primitive, const Triangle& t) {
    const bool lies_inside = std::all_of(
        t.begin(), t.end(), [&](std::uint32_t corner) { return inside[surface.surface_of[corner].value()]; });
    return lies_inside &&
           is_plain_skin(model, primitive, parts[surface.part_of[surface.surface_of[t[0]].value()].value()].role);
  };
  const auto mouth = static_cast<int>(model.materials.size());
  bool is_any_painted = false;
  std::vector<Primitive> runs;
  for (const Primitive& primitive : model.primitives) {
    const std::uint32_t end = primitive.first_triangle + primitive.triangle_count;
    for (std::uint32_t t = primitive.first_triangle; t < end;) {
      Primitive run = primitive;
      run.first_triangle = t;
      const bool painted = is_painted(primitive, model.triangles[t]);
      while (t < end && is_painted(primitive, model.triangles[t]) == painted) ++t;
      run.triangle_count = t - run.first_triangle;
      if (painted) run.material = mouth;
      is_any_painted = is_any_painted || painted;
      runs.push_back(std::move(run));
    }
    if (primitive.triangle_count == 0) runs.push_back(primitive);
  }
  if (!is_any_painted) return;
  model.materials.push_back(plain_material(Plain::mouth));
  model.primitives = std::move(runs);
}

}  // namespace semblante

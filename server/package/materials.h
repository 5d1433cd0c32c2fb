#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// The materials a package carries and which triangle wears which. At least one; at most 255, for packages carry one
/// byte.
struct MaterialAssignment {
  std::vector<Material> materials;
  std::vector<std::uint8_t> of_triangle;  ///< #T
};

/// Keeps the model's materials. Triangles whose material says nothing (none at all, or white without a texture, as when
/// an OBJ comes without its .mtl) get a plain one by what they are: by name first ("Iris", "lashes"), then by the role
/// of their part, so that eyes and teeth do not wear skin. `parts` is by PartId and may be empty: then names alone
/// decide.
MaterialAssignment assign_materials(const Model& model, const Surface& surface, std::span<const Part> parts);

}  // namespace semblante

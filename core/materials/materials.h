#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// The materials of a face package and their assignment to triangles. At least one and at most 255, because packages
/// store one byte.
struct MaterialAssignment {
  std::vector<Material> materials;
  std::vector<std::uint8_t> of_triangle;  ///< #T
};

/// Where to colour irises on eyeballs without materials.
struct EyeLook {
  std::array<std::optional<glm::vec3>, 2> pupils;  ///< centres (3.5, 3.6): left, right
  float iris_diameter = 0.0F;                      ///< model units; 0: unknown, nothing is painted
  /// The irises, left, right, with their pivots; used in place of the two members above if known.
  std::array<std::optional<Iris>, 2> irises;
  std::array<glm::vec3, 2> pivots{glm::vec3(0.0F), glm::vec3(0.0F)};
  std::span<const RigidMotion> motion;  ///< #V file vertices, needed for `irises`
};

/// Keeps the model's materials. Triangles without a material, or with plain white (as for an OBJ without its .mtl), get
/// a plain material by name ("Iris", "lashes"), else by the role of their part, so that eyes and teeth do not look like
/// skin, nor clothing; likewise where the image of the base colour could not be read. On plain eyeballs the triangles
/// around the pupil become iris and pupil; a cornea over them becomes clear. `parts` is by PartId and may be empty:
/// then only names are used.
MaterialAssignment assign_materials(const Model& model, const Surface& surface, std::span<const Part> parts,
                                    const EyeLook& eyes = {});

/// Like assign_materials, for a parametrized head: with the parts and eyes of `rig`.
MaterialAssignment materials_of_rig(const Model& model, const Surface& surface, const Rig& rig);

}  // namespace semblante

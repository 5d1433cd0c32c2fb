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

/// The materials a face package carries and which triangle wears which. At least one; at most 255, for packages carry
/// one byte.
struct MaterialAssignment {
  std::vector<Material> materials;
  std::vector<std::uint8_t> of_triangle;  ///< #T
};

/// Where to paint irises on eyeballs that have no colours of their own.
struct EyeLook {
  std::array<std::optional<glm::vec3>, 2> pupils;  ///< centres (3.5, 3.6): left, right
  float iris_diameter = 0.0F;                      ///< model units; 0: unknown, nothing is painted
  /// Where the irises lie, left, right, and what turns about which pivot; better than the two above where known.
  std::array<std::optional<Iris>, 2> irises;
  std::array<glm::vec3, 2> pivots{glm::vec3(0.0F), glm::vec3(0.0F)};
  std::span<const RigidMotion> motion;  ///< #V file vertices, needed for `irises`
};

/// Keeps the model's materials. Triangles whose material says nothing (none at all, or white without a texture, as when
/// an OBJ comes without its .mtl) get a plain one by what they are: by name first ("Iris", "lashes"), then by the role
/// of their part, so that eyes and teeth do not wear skin. On plain eyeballs the triangles around the pupil become iris
/// and pupil; a cornea over them becomes clear. `parts` is by PartId and may be empty: then names alone decide.
MaterialAssignment assign_materials(const Model& model, const Surface& surface, std::span<const Part> parts,
                                    const EyeLook& eyes = {});

/// The same of a parametrized head: parts and eyes are those of `rig`.
MaterialAssignment materials_of_rig(const Model& model, const Surface& surface, const Rig& rig);

}  // namespace semblante

#pragma once

#include <cstdint>
#include <span>
#include <vector>

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

/// Keeps the model's materials. Triangles without a material, or with plain white (as for an OBJ without its .mtl), get
/// a plain material by name ("Iris", "lashes"), else by the role of their part, so that eyes and teeth do not look like
/// skin, nor clothing; likewise where the image of the base colour could not be read. Where vertices have colours,
/// the plain material is white, which leaves them as they are. On skin, teeth and eyes a blended material becomes a
/// mask: they hide what is behind them, whatever an exporter says. `parts` is by PartId and may be empty: then only
/// names are used. paint_eyes (painted_eyes.h) must run first, for eyes without an iris in the file.
MaterialAssignment assign_materials(const Model& model, const Surface& surface, std::span<const Part> parts);

}  // namespace semblante

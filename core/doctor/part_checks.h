#pragma once

#include <span>
#include <vector>

#include "core/doctor/finding.h"
#include "core/doctor/mesh_sides.h"
#include "core/doctor/subject.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

// The first two need no feature points; `parts` by PartId.

/// Places round which borders that nearly meet are the rims of a slit, lips or lids that touch, and no seam.
struct Slits {
  std::vector<glm::dvec3> places;
  double reach = 0.0;  ///< model units
};

/// Borders of the skin that nearly meet another border but do not stitch. Without `slits` those of mouth and eyes count
/// too.
std::vector<Finding> find_open_seams(const Model& model, const Surface& surface, std::span<const Part> parts,
                                     const MeshSides& mesh, const Slits& slits = {});

/// Neighbouring triangles of the skin that face different ways, and a skin whose outside is its inside.
std::vector<Finding> find_wrong_winding(const Model& model, const Surface& surface, std::span<const Part> parts,
                                        const MeshSides& mesh);

/// Pieces that no point moves and no role explains, a second skin, eyes that cannot turn.
std::vector<Finding> find_idle_parts(const Subject& head);

/// Holes in the skin beside its points.
std::vector<Finding> find_holes(const Subject& head);

}  // namespace semblante

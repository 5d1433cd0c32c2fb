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

// The first two checks need no feature points; `parts` by PartId.

/// Places around which borders that nearly meet are touching lips or lids instead of seams.
struct Slits {
  std::vector<glm::dvec3> places;
  double reach = 0.0;  ///< model units
};

/// Borders of the skin that nearly meet another border but are not stitched. Without `slits` including those of mouth
/// and eyes.
std::vector<Finding> find_open_seams(const Model& model, const Surface& surface, std::span<const Part> parts,
                                     const MeshSides& mesh, const Slits& slits = {});

/// Neighbouring triangles of the skin with opposite winding, and a skin that is inside out.
std::vector<Finding> find_wrong_winding(const Model& model, const Surface& surface, std::span<const Part> parts,
                                        const MeshSides& mesh);

/// Pieces without influence and role, a second skin, eyes that cannot rotate.
std::vector<Finding> find_idle_parts(const Subject& head);

/// Edges of lids that lie in the eyeball.
std::vector<Finding> find_lids_in_eyes(const Subject& head);

/// Holes in the skin near its points.
std::vector<Finding> find_holes(const Subject& head);

/// A head so far from the origin that its coordinates are coarse, and vertices far from the face.
std::vector<Finding> find_far_reach(const Subject& head);

}  // namespace semblante

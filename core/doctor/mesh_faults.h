#pragma once

#include <span>
#include <vector>

#include "core/doctor/finding.h"
#include "core/doctor/mesh_sides.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// Faults of the triangles: degenerate or duplicate triangles, unused vertices, and on the skin, where influence
/// spreads, edges of more than two triangles. One finding per kind, with its vertices as the place. `parts` by PartId.
std::vector<Finding> find_mesh_faults(const Model& model, const Surface& surface, std::span<const Part> parts,
                                      const MeshSides& mesh);

}  // namespace semblante

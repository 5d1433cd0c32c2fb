#pragma once

#include <span>
#include <vector>

#include "core/doctor/finding.h"
#include "core/doctor/mesh_sides.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// Faults of the triangles: degenerate, given twice, vertices that no triangle uses; and on the skin, where influence
/// spreads, more than two at an edge. One finding a kind, its place the vertices concerned. `parts` by PartId.
std::vector<Finding> find_mesh_faults(const Model& model, const Surface& surface, std::span<const Part> parts,
                                      const MeshSides& mesh);

}  // namespace semblante

#pragma once

#include <vector>

#include "core/doctor/finding.h"
#include "core/doctor/mesh_sides.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"

namespace semblante {

/// Faults of the triangles, wherever they are: degenerate, given twice, more than two at an edge; vertices that no
/// triangle uses. One finding a kind, its place the vertices concerned.
std::vector<Finding> find_mesh_faults(const Model& model, const Surface& surface, const MeshSides& mesh);

}  // namespace semblante

#pragma once

#include <span>

#include "core/doctor/report.h"
#include "core/geometry/surface.h"
#include "core/parametrize/weight_method.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// The fit doctor: finds the faults of a head with places and remedies. `surface` must be build_surface(model).
///
/// Checks the mesh only, before feature points are marked. `parts` are those of describe_parts without points.
Report examine_mesh(const Model& model, const Surface& surface, std::span<const Part> parts);

/// Checks the mesh, and the points, parts and weights (made by `method`) of `rig`, which must belong to `model`.
Report examine(const Model& model, const Surface& surface, const Rig& rig, WeightMethod method);

}  // namespace semblante

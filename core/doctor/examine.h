#pragma once

#include <span>

#include "core/doctor/report.h"
#include "core/geometry/surface.h"
#include "core/parametrize/weight_method.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// The fit doctor: what is wrong with a head, where, and what to do about it. `surface` must be build_surface(model).
///
/// What the mesh alone shows, before any feature point is marked. `parts` are those of describe_parts without points.
Report examine_mesh(const Model& model, const Surface& surface, std::span<const Part> parts);

/// Everything: the mesh, the points of `rig`, its parts and its weights, which `method` made. `rig` must be of `model`.
Report examine(const Model& model, const Surface& surface, const Rig& rig, WeightMethod method);

}  // namespace semblante

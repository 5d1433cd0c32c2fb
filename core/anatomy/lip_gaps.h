#pragma once

#include <optional>

#include "core/geometry/surface.h"
#include "core/types/facing_lips.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// Where the lips of a head meet, measured on its mesh: the marked points may lie behind the line along which lips
/// touch. In columns (sections of equal x) between the corners two distances along y are measured: after the first the
/// gap between the lips is no longer visible, after the second their surfaces touch. The result is the closing of the
/// facing points with which all columns, moved by the weights, are closest to between the two. Empty if a point is not
/// marked, the mesh has nothing between the corners, or a mask has skin between its lips.
///
/// Reads the points, the parts, and the influence of `rig`, whose rows are those of the file vertices of `model`.
std::optional<LipGaps> measure_lip_gaps(const Model& model, const Surface& surface, const Rig& rig);

}  // namespace semblante

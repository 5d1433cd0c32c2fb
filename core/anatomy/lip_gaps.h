#pragma once

#include <optional>

#include "core/geometry/surface.h"
#include "core/types/facing_lips.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// The gap between the lips of a head, measured on its mesh, because the marked points may be behind the line along
/// which lips touch. In each column (section of equal x) between the corners two distances along y are measured: closed
/// by the first, the gap between the lips is no longer visible; closed by the second, their surfaces touch. The result
/// is the closing of the facing points for which all columns, moved by the weights, are closest to the range between
/// the two. Lips of one skin (`joined`) close by as much of the distance of their points as it does not fold over.
/// Empty if a point is not marked, or the mesh has no vertices between the corners.
///
/// Reads the points, the parts, and the influence of `rig`, whose rows are those of the file vertices of `model`.
std::optional<LipGaps> measure_lip_gaps(const Model& model, const Surface& surface, const Rig& rig);

}  // namespace semblante

#pragma once

#include <optional>

#include "core/geometry/surface.h"
#include "core/types/facing_lips.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// Where the lips of a head meet, measured on its mesh: the marked points may lie behind the line along which lips
/// touch. In columns (sections of equal x) between the corners the way along y is measured after which the view between
/// the lips is shut, and that after which their surfaces touch. The result is what the facing points have to close so
/// that all columns end nearest to between the two, as the weights carry the points' motion to them. Empty where a
/// point is not marked, nothing lies between the corners, or a mask has skin between its lips.
///
/// Reads the points, the parts, and the influence of `rig`, whose rows are those of the file vertices of `model`.
std::optional<LipGaps> measure_lip_gaps(const Model& model, const Surface& surface, const Rig& rig);

}  // namespace semblante

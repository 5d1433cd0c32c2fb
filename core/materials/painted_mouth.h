#pragma once

#include <span>
#include <vector>

#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// Gives the inside of the mouth the plain material of a mouth where the file gave the skin no look, so that it is dark
/// and red between open lips: adds the material and divides primitives. `inside`: #S, whether a vertex lies in the
/// mouth, or empty; a triangle does if its corners do. `parts` by PartId.
void paint_mouth(Model& model, const Surface& surface, std::span<const Part> parts, const std::vector<bool>& inside);

}  // namespace semblante

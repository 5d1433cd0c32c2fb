#pragma once

#include <vector>

#include "core/geometry/surface.h"
#include "core/types/model.h"

namespace semblante {

/// Of each part, the signed volume that it encloses, relative to the sum of the absolute volumes of its pieces from the
/// middle of its vertices: 1 for a convex closed surface, -1 for one that is inside out, near 0 for a flat sheet.
/// `surface` must be build_surface(model).
std::vector<double> enclosed_volumes(const Model& model, const Surface& surface);

/// Below this share a part is inside out.
inline constexpr double inside_out_share = -0.2;

/// The part with most vertices; there must be one.
PartId largest_part(const Surface& surface);

}  // namespace semblante

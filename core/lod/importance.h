#pragma once

#include <vector>

#include "core/geometry/surface.h"
#include "core/types/rig.h"

namespace semblante {

/// How much an error of the surface counts at each vertex: #S factors of the price of a collapse, at most 1, positive.
///
/// The skin of the face counts fully. Outside the face it falls with the fourth power of the distance from its middle:
/// hair and ears before the neck, the neck before the hands, the body last. Lashes, hair and clothing count less than
/// skin at the same place, and what is mostly hidden behind lids and lips least. Without feature points only the roles
/// count.
std::vector<double> importance_of_vertices(const Surface& surface, const Rig& rig);

}  // namespace semblante

#pragma once

#include <optional>

#include "core/types/articulation.h"
#include "core/types/fapu.h"
#include "core/types/feature_points.h"
#include "core/types/model.h"

namespace semblante {

/// How far a head articulates in its own shapes (morph targets): the articulation at which the library's open vowels
/// (a, e, o) open the mouth, between 2.2 and 2.3, as far as the head's own do, in the least squares; limited to
/// least_articulation and most_articulation. The shapes are those of own_sets: named for the viseme, else the sum of
/// ARKit's. A shape that opens the mouth by less than least_articulation of the library's opening shows something
/// else and does not count. The library's opening is in units_of_library. Empty without such shapes, without MNS, or if
/// 2.2 or 2.3 is on no vertex.
/// `points`, `fapu`: of the neutral head.
std::optional<Articulation> own_articulation(const Model& model, const FeaturePointSet& points, const Fapu& fapu);

}  // namespace semblante

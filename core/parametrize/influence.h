#pragma once

#include <span>
#include <vector>

#include "core/anatomy/jaw_share.h"
#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/parametrize/weight_method.h"
#include "core/types/rig.h"
#include "core/types/weight_table.h"

namespace semblante {

/// Eq. 7's constant part with the roles of parts applied: #S rows.
///
///     skin          W / sum(W)
///     lower teeth   the jaw point 2.1 alone, fully
///     tongue        its own W / sum(W), and 2.1 fully on top: such rows sum to 2
///     attached      the row of the nearest skin vertex
///     eyes, upper teeth, rest: no row; they move rigidly, with the eye or with the head
///     body          no row; it stays
///
/// Weights of `smooth` are shares as they are: their rows are not divided by the sum.
///
/// A part with both rows of teeth (gums with the tongue, joined at the throat) follows the jaw fully at the lower
/// teeth, not at all at the upper ones, and in between by the distances to both.
WeightTable<float> influence_with_roles(const Surface& surface, std::span<const Part> parts,
                                        std::span<const SurfacePoint> points, std::span<const MouthShare> mouth,
                                        const WeightTable<double>& weights, WeightMethod method = WeightMethod::paper);

}  // namespace semblante

#pragma once

#include <span>
#include <vector>

#include "core/parametrize/influence_regions.h"
#include "core/parametrize/point_distances.h"
#include "core/types/weight_table.h"

namespace semblante {

/// Weights W_iP of Eq. 4 for the members of one part: #M rows. `regions` are those of
/// `influence_regions` for the same distances. The row of a feature point's own vertex is (its id, 1) alone; where
/// several points share a vertex, each has weight 1.
WeightTable<double> part_weights(const Surface& surface, const PointDistances& distances,
                                 const std::vector<SlotSet>& regions);

}  // namespace semblante

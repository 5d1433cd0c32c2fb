#pragma once

#include <vector>

#include "core/geometry/surface.h"
#include "core/parametrize/point_distances.h"
#include "core/parametrize/slot_set.h"

namespace semblante {

/// Distances within this relative difference of the smallest are a tie; the lowest id wins.
inline constexpr double distance_tie = 1e-6;
/// A cosine counts as positive above this: symmetric heads have many right angles, which rounding must not decide.
inline constexpr double least_cosine = 1e-6;

/// Region of influence: for each member P of the part the set of points whose regions contain P. A feature point's own
/// vertex is not an ordinary vertex: its set is empty.
std::vector<SlotSet> influence_regions(const Surface& surface, const PointDistances& distances);

/// Points i and j are neighbours if some ordinary vertex is in both regions. #F sets; none holds its own slot.
std::vector<SlotSet> region_neighbors(const std::vector<SlotSet>& regions, std::size_t point_count);

}  // namespace semblante

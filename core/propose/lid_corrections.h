#pragma once

#include "core/propose/draft.h"

namespace semblante {

// Corrections of proposed points of lips and lids, once all points are proposed. Known points stay.

/// Chooses vertices again for points on the wrong lip or lid, by all points beside them, of which some were not yet
/// there at the choice: on a mesh as coarse as a lip the two sides may differ.
void correct_sides(Draft& draft);

/// Moves middles of lids to the edges of the lids. Mirror images miss them where one eye is higher than the other.
void correct_lid_edges(Draft& draft);

/// Moves folds of lids off the edges of the lids, on which they come to lie where the mesh is coarse: the place of an
/// edge that is marked as a fold stays behind in a blink.
void correct_folds(Draft& draft);

}  // namespace semblante

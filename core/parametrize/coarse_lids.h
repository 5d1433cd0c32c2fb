#pragma once

#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// Sets the lift (Lids::lift) of lids with so few vertices that their triangles, flat between vertices that roll on the
/// eyeball, would cut it as the eye closes. Lids whose triangles stay before the ball have none. Reads everything else
/// of the rig that moves lids.
void lift_coarse_lids(const Model& model, Rig& rig);

}  // namespace semblante

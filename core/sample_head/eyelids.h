#pragma once

#include "core/sample_head/skin.h"

namespace semblante::sample_head_detail {

/// Fills the orbit: rings from the hole of the skin inwards to the crease and the edge of the lids, over the edge and
/// back into a socket behind the eyeball. `orbit` starts at the inner corner and runs over the upper lid.
void add_eyelids(Skin& skin, const Loop& orbit);

/// The outer edge of the lids at step k of `lid_steps`, from the inner corner (0) over the upper lid to the outer
/// corner (half way) and back along the lower lid.
inline constexpr int lid_steps = 48;
Vec3 lid_edge(int k);

}  // namespace semblante::sample_head_detail

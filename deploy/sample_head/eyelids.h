#pragma once

#include "deploy/sample_head/skin.h"

namespace semblante::sample_head_detail {

/// Fills the orbit: rings from the hole of the skin inwards to the fold over the upper lid and the edge of the lower
/// one, over the edge and back into a socket behind the eyeball. `orbit` starts at the inner corner and runs over the
/// top.
void add_eyelids(Skin& skin, const Loop& orbit);

inline constexpr int lid_steps = 24;

/// Lines of the lids' edges over the eyeball: y at x, both from the middle of the eye.
double upper_edge_y(double x);
double lower_edge_y(double x);
/// Distance of the fold of the upper lid from the line through the eye's middle along x.
double fold_radius(double x);
inline constexpr double slit_half_width = 1.52;

}  // namespace semblante::sample_head_detail

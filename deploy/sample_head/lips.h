#pragma once

#include "deploy/sample_head/skin.h"

namespace semblante::sample_head_detail {

/// Fills the hole of the mouth: rings to the border of the red, over the lips to their meeting line, and further into a
/// bag for teeth and tongue. `around` runs from the middle above the mouth by the left corner to the middle below.
/// `pressed` lips are thin and all but touch.
void add_lips(Skin& skin, const Loop& around, bool pressed);

/// Steps of half a ring: 0 upper middle, half way the corner, last the lower middle.
inline constexpr int lip_steps = 16;

}  // namespace semblante::sample_head_detail

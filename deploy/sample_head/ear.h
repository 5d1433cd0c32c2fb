#pragma once

#include "deploy/sample_head/skin.h"

namespace semblante::sample_head_detail {

/// Fills the ear's hole in the side of the head with the ear. `hole` starts at the middle of its front edge and runs
/// over the top to the back.
void add_ear(Skin& skin, const Loop& hole);

}  // namespace semblante::sample_head_detail

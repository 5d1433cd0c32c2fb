#pragma once

#include "deploy/sample_head/skin.h"

namespace semblante::sample_head_detail {

/// Closes the nostril by a short blind tube that leads up and back.
void add_nostril(Skin& skin, const Loop& rim);

}  // namespace semblante::sample_head_detail

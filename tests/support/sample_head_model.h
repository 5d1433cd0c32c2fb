#pragma once

#include "core/types/feature_points.h"
#include "core/types/model.h"

namespace semblante::testing {

/// Our own head as import would give it, without materials.
Model sample_head_model();

/// All 84 points of it.
FeaturePointSet sample_head_points();

}  // namespace semblante::testing

#pragma once

#include <array>

#include "core/types/feature_point_id.h"

namespace semblante {

/// Weights of all feature points at one vertex.
using WeightRow = std::array<double, feature_point_count>;

}  // namespace semblante

#pragma once

#include <array>
#include <optional>

#include <glm/vec3.hpp>

#include "core/types/feature_point_id.h"

namespace semblante {

/// The position of each feature point, by FeaturePointId; empty where it is not known.
using Places = std::array<std::optional<glm::dvec3>, feature_point_count>;

}  // namespace semblante

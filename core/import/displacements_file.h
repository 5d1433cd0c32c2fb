#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "core/types/feature_point_id.h"
#include "core/types/result.h"

namespace semblante {

/// {"2.1": [dx, dy, dz], ...}: explicit displacements of feature points, in the model file's axes and unit. By
/// increasing id, at least one. error.where is a JSON pointer such as "/2.1/0".
Result<std::vector<std::pair<FeaturePointId, glm::dvec3>>> parse_displacements(std::string_view json);

}  // namespace semblante

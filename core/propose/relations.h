#pragma once

#include <glm/vec3.hpp>

#include "core/types/feature_point_id.h"
#include "core/types/places.h"

namespace semblante {

/// Applies MPEG-4's position relations to `place` of point `id`, if the related points are in `settled`: half way
/// between two points along one axis, or level with another. The lower lip is nearly as high half way along it as in
/// its middle.
glm::dvec3 apply_relations(FeaturePointId id, glm::dvec3 place, const Places& settled);

/// Whether a relation is known for that point.
bool has_relation(FeaturePointId id);

}  // namespace semblante

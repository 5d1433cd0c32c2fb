#pragma once

#include <span>

#include <glm/vec3.hpp>

#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/rig.h"

namespace semblante {

/// What an eye turns about: the centre of the sphere fitted to the largest part with `role`, its box's centre if it is
/// no ball. A flat disc (an iris alone) or no part at all: as far behind the pupil as an adult's eyeball would have it.
glm::vec3 eye_pivot(const Surface& surface, std::span<const Part> parts, PartRole role, const FeaturePointSet& points);

/// What the head turns about: 7.1, or an estimate from the points or the skin's box.
glm::vec3 head_pivot(std::span<const Part> parts, const FeaturePointSet& points);

}  // namespace semblante

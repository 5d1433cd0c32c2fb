#pragma once

#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "core/geometry/sphere_fit.h"
#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/neck_joints.h"
#include "core/types/rig.h"

namespace semblante {

/// The sphere fitted to the largest part with `role`; empty if there is none or if it is not a ball.
std::optional<Sphere> round_eyeball(const Surface& surface, std::span<const Part> parts, PartRole role);

/// The pivot of an eye: the centre of the sphere fitted to the largest part with `role`, or the centre of its box if it
/// is not a ball. For a flat disc (only an iris) or without a part: behind the pupil, at the distance in an adult's
/// eyeball; without a part also behind the corners of the lids.
glm::vec3 eye_pivot(const Surface& surface, std::span<const Part> parts, PartRole role, const FeaturePointSet& points);

/// The pivot of the head: 7.1, or the head's joint of `joints` (the result of plausible_joints()), or an estimate from
/// the points or the skin's box.
glm::vec3 head_pivot(std::span<const Part> parts, const FeaturePointSet& points, const NeckJoints& joints = {});

}  // namespace semblante

#pragma once

#include <span>

#include "core/types/feature_points.h"
#include "core/types/neck_joints.h"
#include "core/types/rig.h"

namespace semblante {

/// The joints of a skeleton that can be those of this head: both behind the chin and near the middle; the head's from
/// the eyes down to half the face's height below the chin; the neck's below the chin and the head's joint, above where
/// shoulders can be. The others are left out. Without points of eyes and chin, none is kept.
NeckJoints plausible_joints(const NeckJoints& joints, std::span<const Part> parts, const FeaturePointSet& points);

}  // namespace semblante

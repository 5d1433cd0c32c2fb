#pragma once

#include <array>

#include "core/doctor/face_axes.h"

namespace semblante {

/// The asymmetry of each marked point as a fraction of ES0: for a middle point its distance from the mirror plane, for
/// another its distance from the mirrored position of its partner. Both points of a pair have the same value, because
/// symmetry cannot decide which one is wrong. 0 if a point or its partner is not marked, or the face has no ES0.
std::array<double, feature_point_count> mirror_offsets(const FaceAxes& face);

}  // namespace semblante

#pragma once

#include <array>

#include "core/doctor/face_frame.h"

namespace semblante {

/// How far each marked point is off the place that the mirror plane of the face gives it, as a share of ES0: a point in
/// the middle off the plane, another off the mirrored place of its partner. Both of a pair have the same value: which
/// of them is wrong, symmetry cannot tell. 0 where a point or its partner is not marked, or the face has no ES0.
std::array<double, feature_point_count> mirror_offsets(const FaceFrame& face);

}  // namespace semblante

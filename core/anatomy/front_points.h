#pragma once

#include "core/types/feature_point_id.h"

namespace semblante {

/// Whether a point lies on the front of the face, whose outer surface faces forward. Not so the inner rims of lips and
/// lids, and the sides of the head.
bool is_on_front(FeaturePointId id);

/// Cosines between a surface's normal and the forward axis of the face. The outer surface at the points of the front
/// has 0.4 or more, even on a cheek or nose bone. Below `faces_away`, 12 degrees beyond sideways, a surface is
/// certainly behind it: the inner wall of a double one, or a mouth bag. A proposed point is on one above
/// `faces_forward`, half way between, where there is one.
inline constexpr double faces_away = -0.2;
inline constexpr double faces_forward = 0.1;

}  // namespace semblante

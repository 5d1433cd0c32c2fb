#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/neck_joints.h"
#include "core/types/rig.h"

namespace semblante {

/// Computes how much of the head's rotation (FAP 48 to 50) each surface vertex gets, in 255ths: 255 on the head, 0 on
/// shoulders and body. Along the neck it decreases with the distance along the surface from the head: in front mostly
/// at the shoulders, at the back mostly at the head. Returns #S values; empty if the model has no neck, so that all of
/// it turns.
///
/// Head and neck are measured on the skin of the face: the head is above the line from the chin to the nape; the
/// shoulders begin where the neck widens. Where the skin ends below the jaw (a neck that is cut, also askew, or that
/// ends in a collar), it stays. Each other part gets one value: 255 (hair, glasses, eyes), or 0 if it hangs at the
/// shoulders. The latter also gets the role `body`, unless the user set another role. The values of a part that is worn
/// on the head and reaches below the shoulders (long hair) fall off by height from the jaw to the shoulders, where it
/// lies still.
///
/// If there is a joint of the neck and the shoulders are measured far from it, they begin at the joint.
///
/// Needs points that show the height of the eyes (pupils, else lids, else eyeballs) and of the chin (2.1, else 2.10,
/// else a lip). `head_pivot` is the result of head_pivot(), `joints` of plausible_joints().
std::vector<std::uint8_t> turn_with_head(const Surface& surface, std::span<Part> parts, const FeaturePointSet& points,
                                         const glm::vec3& head_pivot, const NeckJoints& joints = {});

}  // namespace semblante

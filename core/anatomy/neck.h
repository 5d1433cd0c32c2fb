#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/rig.h"

namespace semblante {

/// The share of the head's rotation at each surface vertex, in 255ths: 255 on the head, 0 on shoulders and body, and
/// between them, along the neck, by the distances along the surface to both. #S; empty if the model is a head without
/// a neck, which turns as a whole.
///
/// The skin of the face defines head and neck: the head is above the line from the chin to the nape, the shoulders
/// begin where the neck widens, or at the lower border of a neck that is cut. Every other part turns as a whole: fully
/// (hair, glasses, eyes), or not at all: a part that hangs at the shoulders gets the role `body`, unless the user set
/// another one.
///
/// Needs the height of the eyes (pupils, else lids, else eyeballs) and of the chin (2.1, else 2.10, else a lip).
/// `head_pivot`: as from head_pivot().
std::vector<std::uint8_t> turn_with_head(const Surface& surface, std::span<Part> parts, const FeaturePointSet& points,
                                         const glm::vec3& head_pivot);

}  // namespace semblante

#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "core/types/rig.h"

namespace semblante {

/// Radius of an adult's iris by that of the eyeball.
inline constexpr float iris_of_ball = 0.49F;
/// The greatest share that `iris_radius` gives: that of a small child, whose iris is nearly full-grown in a smaller
/// ball.
inline constexpr float widest_iris_of_ball = 0.55F;

/// The radius of the ball of the eye with `role`: half the width or height of its widest part, whichever is more.
/// nullopt without a part, and if that part is flat: a disc may be all iris.
inline std::optional<float> eyeball_radius(std::span<const Part> parts, PartRole role) {
  float widest = 0.0F;
  float depth = 0.0F;
  for (const Part& part : parts) {
    const glm::vec3 extent = part.box_max - part.box_min;
    const float width = std::max(extent.x, extent.y);
    if (part.role != role || width <= widest) continue;
    widest = width;
    depth = extent.z;
  }
  constexpr float flat = 0.4F;
  return widest > 0.0F && depth >= flat * widest ? std::optional(0.5F * widest) : std::nullopt;
}

/// The radius of an iris whose size no part of the mesh tells: half of IRISD0, because in the standard's neutral face
/// the lids touch the iris; at most `widest_iris_of_ball` of the eyeball, because the lids of a drawn figure may be far
/// apart. Both in model units.
inline double iris_radius(double irisd0, std::span<const Part> parts, PartRole role) {
  const std::optional<float> ball = eyeball_radius(parts, role);
  return ball ? std::min(0.5 * irisd0, static_cast<double>(widest_iris_of_ball * *ball)) : 0.5 * irisd0;
}

}  // namespace semblante

#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "core/kernel/semblante_kernel.h"
#include "core/types/moving_parts.h"

namespace semblante {

inline void copy_vector(const glm::vec3& from, float (&to)[3]) {
  to[0] = from.x;
  to[1] = from.y;
  to[2] = from.z;
}

inline semblante_lids to_kernel(const std::optional<Lids>& lids) {
  semblante_lids result{};
  if (!lids) return result;
  copy_vector(lids->gaze, result.gaze);
  result.slit = lids->slit;
  result.opening = lids->opening;
  std::copy(lids->gaze_share.begin(), lids->gaze_share.end(), std::begin(result.gaze_share));
  std::copy(lids->ball.begin(), lids->ball.end(), std::begin(result.ball));
  result.lift = lids->lift;
  return result;
}

/// Sets irises, lids (left, right) and tongue of a kernel rig; an empty one becomes one that does not move.
inline void set_moving_parts(const std::array<std::optional<Iris>, 2>& irises, const std::optional<Tongue>& tongue,
                             const std::array<std::optional<Lids>, 2>& lids, semblante_rig& rig) {
  for (std::size_t eye = 0; eye < lids.size(); ++eye) rig.lids[eye] = to_kernel(lids[eye]);
  for (std::size_t eye = 0; eye < irises.size(); ++eye) {
    rig.iris[eye] = {};
    if (!irises[eye]) continue;
    copy_vector(irises[eye]->axis, rig.iris[eye].axis);
    rig.iris[eye].pupil_radius = irises[eye]->pupil_radius;
    rig.iris[eye].iris_radius = irises[eye]->iris_radius;
    rig.iris[eye].bend = irises[eye]->bend;
  }
  rig.tongue = {};
  if (!tongue) return;
  copy_vector(tongue->origin, rig.tongue.origin);
  copy_vector(tongue->left, rig.tongue.left);
  copy_vector(tongue->up, rig.tongue.up);
  rig.tongue.half_width = tongue->half_width;
  rig.tongue.roll_limit = tongue->roll_limit;
}

}  // namespace semblante

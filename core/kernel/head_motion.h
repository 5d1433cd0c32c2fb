/* Internal: the head's rotation, of which a vertex of the neck has a share and one of the body none. */
#ifndef SEMBLANTE_KERNEL_HEAD_MOTION_H
#define SEMBLANTE_KERNEL_HEAD_MOTION_H

#include "core/kernel/rigid_motion.h"
#include "core/kernel/semblante_kernel.h"

/* The head's motion for a vertex with `turn` 255ths of it, 1 to 254: the rotation between none and q, by normalized
 * linear interpolation along the shorter arc. */
static inline semblante_rigid_motion semblante_part_of_turn(const float q[4], const float pivot[3], uint8_t turn) {
  static const float still[3] = {0.0F, 0.0F, 0.0F};
  const float share = (float)turn / (float)SEMBLANTE_TURN_FULL;
  const float side = q[3] < 0.0F ? -share : share;
  const float r[4] = {side * q[0], side * q[1], side * q[2], (1.0F - share) + side * q[3]};
  /* The length is at least sqrt(1/2). */
  const float length = __builtin_sqrtf(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
  const float unit[4] = {r[0] / length, r[1] / length, r[2] / length, r[3] / length};
  return semblante_rigid_motion_of(unit, pivot, still);
}

#endif

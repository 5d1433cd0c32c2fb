/* Internal: the motions of irises, eyes, lids and tongue, which precede the motion of the head. semblante_face.rigid
 * defines the motion of each vertex. */
#ifndef SEMBLANTE_KERNEL_LOCAL_MOTION_H
#define SEMBLANTE_KERNEL_LOCAL_MOTION_H

#include <stdint.h>

#include "core/kernel/lids.h"
#include "core/kernel/rigid_motion.h"
#include "core/kernel/semblante_kernel.h"

/* The local motions of a pose, computed once for all vertices. */
typedef struct semblante_local_motions {
  const semblante_pose* pose;
  semblante_rigid_motion eye[2];
  semblante_lid_roll lids[2];
} semblante_local_motions;

/* The eye (0 left, 1 right) whose lids a vertex belongs to, or -1. */
static inline int semblante_lids_of(uint8_t rigid) {
  return rigid == SEMBLANTE_RIGID_LEFT_LIDS ? 0 : rigid == SEMBLANTE_RIGID_RIGHT_LIDS ? 1 : -1;
}

/* `pose` must outlive the motions. */
void semblante_prepare_local(const semblante_pose* pose, semblante_local_motions* motions);

/* Moves one vertex of the tongue: `rigid` is at least SEMBLANTE_RIGID_TONGUE; `rest`: its position on the neutral face;
 * `p`: on input the position by Eq. 7, on output the position before the motion of the head. */
void semblante_roll_tongue(const semblante_pose* pose, uint8_t rigid, const float rest[3], float p[3]);

#endif

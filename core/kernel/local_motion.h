/* Internal: the motions of irises, eyes and tongue, which precede the motion of the head. semblante_face.rigid defines
 * the motion of each vertex. */
#ifndef SEMBLANTE_KERNEL_LOCAL_MOTION_H
#define SEMBLANTE_KERNEL_LOCAL_MOTION_H

#include <stdint.h>

#include "core/kernel/rigid_motion.h"
#include "core/kernel/semblante_kernel.h"

/* The local motions of a pose, computed once for all vertices. */
typedef struct semblante_local_motions {
  const semblante_pose* pose;
  semblante_rigid_motion eye[2];
} semblante_local_motions;

/* `pose` must outlive the motions. */
void semblante_prepare_local(const semblante_pose* pose, semblante_local_motions* motions);

/* Moves one vertex. `rigid` must not be SEMBLANTE_RIGID_NONE; `rest`: its position on the neutral face; `p`: on input
 * the position by Eq. 7, on output the position before the motion of the head. */
void semblante_move_local(const semblante_local_motions* motions, uint8_t rigid, const float rest[3], float p[3]);

#endif

/* Internal: what moves single parts of a head before the head itself moves: irises, eyes and tongue. Which vertices it
 * moves is semblante_face.rigid. */
#ifndef SEMBLANTE_KERNEL_LOCAL_MOTION_H
#define SEMBLANTE_KERNEL_LOCAL_MOTION_H

#include <stdint.h>

#include "core/kernel/rigid_motion.h"
#include "core/kernel/semblante_kernel.h"

/* A pose, prepared once for all the vertices. */
typedef struct semblante_local_motions {
  const semblante_pose* pose;
  semblante_rigid_motion eye[2];
} semblante_local_motions;

/* `pose` must outlive the motions. */
void semblante_prepare_local(const semblante_pose* pose, semblante_local_motions* motions);

/* Moves one vertex. `rigid` is not SEMBLANTE_RIGID_NONE; `rest` is where the vertex is on the neutral face; `p` comes
 * in as rest plus Eq. 7 and leaves ready for the motion of the head. */
void semblante_move_local(const semblante_local_motions* motions, uint8_t rigid, const float rest[3], float p[3]);

#endif

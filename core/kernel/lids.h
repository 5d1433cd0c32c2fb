/* Internal: lids that roll on the eyeball. */
#ifndef SEMBLANTE_KERNEL_LIDS_H
#define SEMBLANTE_KERNEL_LIDS_H

#include "core/kernel/rigid_motion.h"
#include "core/kernel/semblante_kernel.h"

/* The points that move the lids of an eye (0 left, 1 right). */
#define SEMBLANTE_UPPER_LID(eye) ((uint32_t)(SEMBLANTE_FP_LEFT_UPPER_LID + (eye)))
#define SEMBLANTE_LOWER_LID(eye) ((uint32_t)(SEMBLANTE_FP_LEFT_LOWER_LID + (eye)))

/* pose->lid_closure of one eye, from the displacements in pose->fp and the eye's pitch (radians, positive down). */
void semblante_close_lids(int eye, float pitch, semblante_pose* pose);

/* The roll of the lids of one eye in a pose, for all their vertices. */
typedef struct semblante_lid_roll {
  const semblante_lids* lids;
  const float* upper; /* displacement of the upper lid's point, which Eq. 7 has applied */
  const float* lower;
  const float* closure; /* upper, lower */
  const float* pivot;
  float ball_center[3];
  float pole[3]; /* of the ball in this pose */
  int moves;     /* 0: lids and ball are neutral, so that a vertex at rest stays bit for bit */
} semblante_lid_roll;

void semblante_prepare_lid_roll(int eye, const semblante_pose* pose, const semblante_rigid_motion* ball,
                                semblante_lid_roll* roll);

/* Moves one vertex with the weights `upper` and `lower` of the two points. `p`: on input the position by Eq. 7, on
 * output with the height that the closures give it, on its circle round the eye, and off the ball. */
void semblante_roll_lid(const semblante_lid_roll* roll, float upper, float lower, const float rest[3], float p[3]);

#endif

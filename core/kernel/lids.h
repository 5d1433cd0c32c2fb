/* Internal: lids that roll on the eyeball. */
#ifndef SEMBLANTE_KERNEL_LIDS_H
#define SEMBLANTE_KERNEL_LIDS_H

#include "core/kernel/rigid_motion.h"
#include "core/kernel/semblante_kernel.h"

/* The points that move the lids of an eye (0 left, 1 right). */
#define SEMBLANTE_UPPER_LID(eye) ((uint32_t)(SEMBLANTE_FP_LEFT_UPPER_LID + (eye)))
#define SEMBLANTE_LOWER_LID(eye) ((uint32_t)(SEMBLANTE_FP_LEFT_LOWER_LID + (eye)))

/* A lid gains its clearance from the ball over the first radians of its way, or of the ball's. */
#define SEMBLANTE_LID_GAIN_OVER 0.1F
/* A vertex slides on its circle while its depth before the axis is more than this share of the circle's radius. */
#define SEMBLANTE_LID_NEAREST 0.05F

/* The unit of a FAP of the point `fp`, whose unit on the face is `unit`: of a lid that rolls, of an eye that is open
 * wider than IRISD, its own opening, so that 1024 closes either of two unequal eyes. */
float semblante_unit_at(uint8_t fp, float unit, const semblante_lids lids[2]);

/* Stops the points of the lids of one eye in pose->fp where the eye is closed, and moves them as far as open lids
 * follow its pitch (radians, positive down): what follows the points, as the folds of lids, does so too. */
void semblante_stop_lids(int eye, float pitch, semblante_pose* pose);

/* pose->lid_closure of one eye, from the displacements in pose->fp. */
void semblante_close_lids(int eye, semblante_pose* pose);

/* The roll of the lids of one eye in a pose, for all their vertices. */
typedef struct semblante_lid_roll {
  const semblante_lids* lids;
  const float* upper; /* displacement of the upper lid's point, which Eq. 7 has applied */
  const float* lower;
  const float* closure; /* upper, lower */
  const float* pivot;
  float ball_center[3];
  float pole[3];      /* of the ball in this pose */
  float swing;        /* length of the way of the pole from the neutral face */
  float gain;         /* of a vertex's clearance by its way: share for each unit of length */
  float gained;       /* by the ball's way */
  float clearance;    /* that a lid keeps from the ball */
  float square_reach; /* squared distance from the ball's centre from which on every vertex has its clearance */
  int moves;          /* 0: lids and ball are neutral, so that a vertex at rest stays bit for bit */
} semblante_lid_roll;

/* The distance of a vertex from the eye's ball on the neutral face, as roll_lids (lane_motions.h) computes it. */
float semblante_clearance_at_rest(const semblante_lids* lids, const float pivot[3], const float rest[3]);

void semblante_prepare_lid_roll(int eye, const semblante_pose* pose, const semblante_rigid_motion* ball,
                                semblante_lid_roll* roll);

#endif

/* Internal: the motion of a rigid part in a pose. lane_motions.h applies it to vertices. */
#ifndef SEMBLANTE_KERNEL_RIGID_MOTION_H
#define SEMBLANTE_KERNEL_RIGID_MOTION_H

/* x += (R - 1)(x - pivot) + translation. Written as a change of x, so that without a rotation the result is
 * bit-identical. */
typedef struct semblante_rigid_motion {
  float change[3][3]; /* R - 1 */
  float pivot[3];
  float translation[3];
} semblante_rigid_motion;

static inline semblante_rigid_motion semblante_rigid_motion_of(const float q[4], const float pivot[3],
                                                               const float translation[3]) {
  const float x = q[0];
  const float y = q[1];
  const float z = q[2];
  const float w = q[3];
  const semblante_rigid_motion m = {{{-2.0F * (y * y + z * z), 2.0F * (x * y - w * z), 2.0F * (x * z + w * y)},
                                     {2.0F * (x * y + w * z), -2.0F * (x * x + z * z), 2.0F * (y * z - w * x)},
                                     {2.0F * (x * z - w * y), 2.0F * (y * z + w * x), -2.0F * (x * x + y * y)}},
                                    {pivot[0], pivot[1], pivot[2]},
                                    {translation[0], translation[1], translation[2]}};
  return m;
}

#endif

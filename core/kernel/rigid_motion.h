/* Internal: the motion of a rigid part in a pose. Inline, because the head's motion applies to every vertex. */
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

static inline void semblante_move(const semblante_rigid_motion* m, float p[3]) {
  const float d[3] = {p[0] - m->pivot[0], p[1] - m->pivot[1], p[2] - m->pivot[2]};
  for (int i = 0; i < 3; ++i) {
    p[i] += (m->change[i][0] * d[0] + m->change[i][1] * d[1] + m->change[i][2] * d[2]) + m->translation[i];
  }
}

#endif

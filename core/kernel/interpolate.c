/* Linear interpolation between poses. */
#include "core/kernel/export.h"
#include "core/kernel/semblante_kernel.h"

static float lerp(float a, float b, float t) { return a + t * (b - a); }

/* Normalized linear interpolation: follows the great arc with a slightly uneven speed. The error of the angle is at
 * most 0.03 degrees for a step of 30 degrees, 0.9 for one of 90 (tested): not noticeable, and a change would alter the
 * results of every client. */
static void interpolate_rotation(const float a[4], const float b[4], float t, float out[4]) {
  const float dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const float side = dot < 0.0F ? -1.0F : 1.0F; /* q and -q are the same rotation: uses the nearer one */
  float q[4];
  for (int i = 0; i < 4; ++i) {
    q[i] = lerp(a[i], side * b[i], t);
  }
  /* With dot >= 0 the length is at least sqrt(1/2). */
  const float length = __builtin_sqrtf(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int i = 0; i < 4; ++i) {
    out[i] = q[i] / length;
  }
}

SEMBLANTE_EXPORT(semblante_interpolate)
void semblante_interpolate(const semblante_pose* a, const semblante_pose* b, float t, semblante_pose* out) {
  if (!(t > 0.0F)) {
    *out = *a;
    return;
  }
  if (t >= 1.0F) {
    *out = *b;
    return;
  }
  for (int i = 0; i < SEMBLANTE_FP_COUNT * 3; ++i) {
    out->fp[i] = lerp(a->fp[i], b->fp[i], t);
  }
  for (int i = 0; i < 3; ++i) {
    for (int eye = 0; eye < 2; ++eye) {
      out->eye_translation[eye][i] = lerp(a->eye_translation[eye][i], b->eye_translation[eye][i], t);
      out->eye_pivot[eye][i] = a->eye_pivot[eye][i];
    }
    out->head_pivot[i] = a->head_pivot[i];
  }
  for (int eye = 0; eye < 2; ++eye) {
    out->pupil_growth[eye] = lerp(a->pupil_growth[eye], b->pupil_growth[eye], t);
    out->iris[eye] = a->iris[eye];
    for (int lid = 0; lid < 2; ++lid) {
      out->lid_closure[eye][lid] = lerp(a->lid_closure[eye][lid], b->lid_closure[eye][lid], t);
    }
    out->lids[eye] = a->lids[eye];
  }
  out->tongue_roll = lerp(a->tongue_roll, b->tongue_roll, t);
  out->tongue = a->tongue;
  interpolate_rotation(a->eye_rotation[0], b->eye_rotation[0], t, out->eye_rotation[0]);
  interpolate_rotation(a->eye_rotation[1], b->eye_rotation[1], t, out->eye_rotation[1]);
  interpolate_rotation(a->head_rotation, b->head_rotation, t, out->head_rotation);
}

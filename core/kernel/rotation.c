#include "core/kernel/rotation.h"

#include "core/kernel/export.h"
#include "core/kernel/semblante_kernel.h"

SEMBLANTE_EXPORT(semblante_sincos)
void semblante_sincos(float angle, float* sine, float* cosine) {
  *sine = 0.0F;
  *cosine = 1.0F;
  if (!(angle > -1e6F && angle < 1e6F)) {
    return; /* not a plausible angle of a face; also NaN */
  }
  /* Removes quarter turns, then Taylor about 0 on [-pi/4, pi/4]: the first omitted terms are below 4e-10. */
  const double quarter = 1.57079632679489661923;
  const double turns = angle / quarter;
  const int32_t n = (int32_t)(turns + (turns < 0.0 ? -0.5 : 0.5));
  const double x = angle - n * quarter;
  const double x2 = x * x;
  const double s = x * (1.0 + x2 * (-1.0 / 6 + x2 * (1.0 / 120 + x2 * (-1.0 / 5040 + x2 * (1.0 / 362880)))));
  const double c = 1.0 + x2 * (-1.0 / 2 + x2 * (1.0 / 24 + x2 * (-1.0 / 720 + x2 * (1.0 / 40320 - x2 / 3628800))));
  switch ((uint32_t)n & 3U) {
    case 0:
      *sine = (float)s, *cosine = (float)c;
      break;
    case 1:
      *sine = (float)c, *cosine = (float)-s;
      break;
    case 2:
      *sine = (float)-s, *cosine = (float)-c;
      break;
    default:
      *sine = (float)-c, *cosine = (float)s;
      break;
  }
}

void semblante_turn_after(float q[4], int axis, float value) {
  float r[4] = {0.0F, 0.0F, 0.0F, 1.0F};
  semblante_sincos(0.5F * value * SEMBLANTE_AU_RADIANS, &r[axis], &r[3]);
  const float x = r[3] * q[0] + r[0] * q[3] + r[1] * q[2] - r[2] * q[1];
  const float y = r[3] * q[1] + r[1] * q[3] + r[2] * q[0] - r[0] * q[2];
  const float z = r[3] * q[2] + r[2] * q[3] + r[0] * q[1] - r[1] * q[0];
  const float w = r[3] * q[3] - r[0] * q[0] - r[1] * q[1] - r[2] * q[2];
  q[0] = x, q[1] = y, q[2] = z, q[3] = w;
}

#include "core/kernel/local_motion.h"

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static float clamped(float value, float low, float high) { return value < low ? low : value > high ? high : value; }

/* Bends a sheet of half width w about its middle line, so that its borders rotate by `roll`: an arc of curvature
 * k = roll / w. A point at u across the sheet and v above it moves to (sin(t) / k - v sin(t), (1 - cos(t)) / k + v
 * cos(t)) with t = k u; beyond the border it continues along the tangent. */
void semblante_roll_tongue(const semblante_pose* pose, uint8_t rigid, const float rest[3], float p[3]) {
  const semblante_tongue* const tongue = &pose->tongue;
  const float roll = (float)(rigid - (SEMBLANTE_RIGID_TONGUE - 1)) / 128.0F * pose->tongue_roll;
  if (roll == 0.0F || tongue->half_width <= 0.0F) {
    return;
  }
  const float d[3] = {rest[0] - tongue->origin[0], rest[1] - tongue->origin[1], rest[2] - tongue->origin[2]};
  const float u = dot(d, tongue->left);
  const float v = dot(d, tongue->up);
  const float curvature = roll / tongue->half_width;
  const float on_arc = clamped(u, -tongue->half_width, tongue->half_width);
  const float beyond = u - on_arc;
  float half_sine;
  float half_cosine;
  semblante_sincos(0.5F * curvature * on_arc, &half_sine, &half_cosine);
  const float sine = 2.0F * half_sine * half_cosine;
  const float versine = 2.0F * half_sine * half_sine; /* 1 - cosine, without cancellation */
  const float across = (sine / curvature - on_arc) - beyond * versine - v * sine;
  const float upwards = versine / curvature + beyond * sine - v * versine;
  for (int i = 0; i < 3; ++i) {
    p[i] += across * tongue->left[i] + upwards * tongue->up[i];
  }
}

void semblante_prepare_local(const semblante_pose* pose, semblante_local_motions* motions) {
  motions->pose = pose;
  for (int eye = 0; eye < 2; ++eye) {
    motions->eye[eye] =
        semblante_rigid_motion_of(pose->eye_rotation[eye], pose->eye_pivot[eye], pose->eye_translation[eye]);
    semblante_prepare_lid_roll(eye, pose, &motions->eye[eye], &motions->lids[eye]);
  }
}

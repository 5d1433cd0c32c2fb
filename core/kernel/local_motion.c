#include "core/kernel/local_motion.h"

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static float clamped(float value, float low, float high) { return value < low ? low : value > high ? high : value; }

/* Changes the size of a pupil: adds to p the displacement of the rest position along its radius and along the curved
 * surface. */
static void move_iris(const semblante_iris* iris, const float pivot[3], float growth, const float rest[3], float p[3]) {
  if (growth == 0.0F || iris->pupil_radius <= 0.0F) {
    return;
  }
  const float d[3] = {rest[0] - pivot[0], rest[1] - pivot[1], rest[2] - pivot[2]};
  const float along = dot(d, iris->axis);
  const float out[3] = {d[0] - along * iris->axis[0], d[1] - along * iris->axis[1], d[2] - along * iris->axis[2]};
  const float r = __builtin_sqrtf(dot(out, out));
  float stretch = 0.0F; /* the vertex moves outwards by stretch * r */
  if (r < iris->pupil_radius) {
    stretch = growth / iris->pupil_radius;
  } else if (r < iris->iris_radius) {
    stretch = growth * (iris->iris_radius - r) / ((iris->iris_radius - iris->pupil_radius) * r);
  }
  /* bend * ((r + stretch r)^2 - r^2) */
  const float sink = iris->bend * (r * r) * (stretch * (2.0F + stretch));
  for (int i = 0; i < 3; ++i) {
    p[i] += stretch * out[i] + sink * iris->axis[i];
  }
}

/* Bends a sheet of half width w about its middle line, so that its borders rotate by `roll`: an arc of curvature
 * k = roll / w. A point at u across the sheet and v above it moves to (sin(t) / k - v sin(t), (1 - cos(t)) / k + v
 * cos(t)) with t = k u; beyond the border it continues along the tangent. */
static void roll_tongue(const semblante_tongue* tongue, float roll, const float rest[3], float p[3]) {
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

void semblante_move_local(const semblante_local_motions* motions, uint8_t rigid, semblante_lid_weights weights,
                          const float rest[3], float p[3]) {
  const semblante_pose* const pose = motions->pose;
  const int lids = semblante_lids_of(rigid);
  if (lids >= 0) {
    semblante_roll_lid(&motions->lids[lids], weights.upper, weights.lower, rest, p);
    return;
  }
  if (rigid >= SEMBLANTE_RIGID_TONGUE) {
    const float share = (float)(rigid - (SEMBLANTE_RIGID_TONGUE - 1)) / 128.0F;
    roll_tongue(&pose->tongue, share * pose->tongue_roll, rest, p);
    return;
  }
  const int eye = rigid == SEMBLANTE_RIGID_LEFT_EYE || rigid == SEMBLANTE_RIGID_LEFT_IRIS ? 0 : 1;
  if (rigid == SEMBLANTE_RIGID_LEFT_IRIS || rigid == SEMBLANTE_RIGID_RIGHT_IRIS) {
    move_iris(&pose->iris[eye], pose->eye_pivot[eye], pose->pupil_growth[eye], rest, p);
  }
  semblante_move(&motions->eye[eye], p);
}

/* Smooth interpolation between poses. */
#include "core/kernel/export.h"
#include "core/kernel/semblante_ease.h"

/* The weights of the Hermite form at one parameter, and the three spans, which determine the weights of the slopes. */
typedef struct curve {
  float from, to, slope_from, slope_to; /* weights of the values, and of the slopes times the middle span */
  float spans[3];
} curve;

static curve make_curve(const float spans[3], float t) {
  const float s = t * t * (3.0F - 2.0F * t);
  curve made = {1.0F - s, s, t * (1.0F - t) * (1.0F - t), t * t * (t - 1.0F), {spans[0], spans[1], spans[2]}};
  return made;
}

/* The slope at the point between two spans, from the slopes within them. */
static float slope(float left, float right, float left_span, float right_span) {
  if (!(left * right > 0.0F)) {
    return 0.0F;
  }
  const float a = 2.0F * right_span + left_span;
  const float b = right_span + 2.0F * left_span;
  return (a + b) / (a / left + b / right);
}

static float at(const curve* c, float before, float from, float to, float after) {
  const float* h = c->spans;
  const float middle = (to - from) / h[1];
  const float first = h[0] > 0.0F ? slope((from - before) / h[0], middle, h[0], h[1]) : 0.0F;
  const float last = h[2] > 0.0F ? slope(middle, (after - to) / h[2], h[1], h[2]) : 0.0F;
  return c->from * from + c->to * to + h[1] * (c->slope_from * first + c->slope_to * last);
}

static float side(const float a[4], const float b[4]) {
  const float dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  return dot < 0.0F ? -1.0F : 1.0F; /* q and -q are the same rotation: uses the nearer one */
}

static void ease_rotation(const curve* c, const float before[4], const float from[4], const float to[4],
                          const float after[4], float out[4]) {
  const float to_side = side(from, to);
  const float before_side = side(before, from);
  const float after_side = to_side * side(to, after);
  float q[4];
  for (int i = 0; i < 4; ++i) {
    q[i] = at(c, before_side * before[i], from[i], to_side * to[i], after_side * after[i]);
  }
  /* Each component is between those of two quaternions with an angle below 90 degrees: never 0. */
  const float length = __builtin_sqrtf(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int i = 0; i < 4; ++i) {
    out[i] = length > 0.0F ? q[i] / length : from[i];
  }
}

SEMBLANTE_EXPORT(semblante_ease)
void semblante_ease(const semblante_pose* before, const semblante_pose* from, const semblante_pose* to,
                    const semblante_pose* after, const float spans[3], float t, semblante_pose* out) {
  if (!(t > 0.0F) || !(spans[1] > 0.0F)) {
    *out = *from;
    return;
  }
  if (t >= 1.0F) {
    *out = *to;
    return;
  }
  const curve c = make_curve(spans, t);
  float rotations[3][4];
  for (int eye = 0; eye < 2; ++eye) {
    ease_rotation(&c, before->eye_rotation[eye], from->eye_rotation[eye], to->eye_rotation[eye],
                  after->eye_rotation[eye], rotations[eye]);
  }
  ease_rotation(&c, before->head_rotation, from->head_rotation, to->head_rotation, after->head_rotation, rotations[2]);
  for (int i = 0; i < SEMBLANTE_FP_COUNT * 3; ++i) {
    out->fp[i] = at(&c, before->fp[i], from->fp[i], to->fp[i], after->fp[i]);
  }
  for (int eye = 0; eye < 2; ++eye) {
    for (int i = 0; i < 3; ++i) {
      out->eye_translation[eye][i] = at(&c, before->eye_translation[eye][i], from->eye_translation[eye][i],
                                        to->eye_translation[eye][i], after->eye_translation[eye][i]);
      out->eye_pivot[eye][i] = from->eye_pivot[eye][i];
    }
    out->pupil_growth[eye] =
        at(&c, before->pupil_growth[eye], from->pupil_growth[eye], to->pupil_growth[eye], after->pupil_growth[eye]);
    out->iris[eye] = from->iris[eye];
    for (int lid = 0; lid < 2; ++lid) {
      out->lid_closure[eye][lid] = at(&c, before->lid_closure[eye][lid], from->lid_closure[eye][lid],
                                      to->lid_closure[eye][lid], after->lid_closure[eye][lid]);
    }
    out->lids[eye] = from->lids[eye];
  }
  out->tongue_roll = at(&c, before->tongue_roll, from->tongue_roll, to->tongue_roll, after->tongue_roll);
  out->tongue = from->tongue;
  for (int i = 0; i < 3; ++i) {
    out->head_pivot[i] = from->head_pivot[i];
  }
  for (int i = 0; i < 4; ++i) {
    out->eye_rotation[0][i] = rotations[0][i];
    out->eye_rotation[1][i] = rotations[1][i];
    out->head_rotation[i] = rotations[2][i];
  }
}

/* Lids roll on the eyeball: a vertex takes the height that the closures of its lids give it by Eq. 7 and slides there
 * on its circle round the eye, in the plane of constant x. Seen from the front lids move as Eq. 7 says, so that rims
 * whose weights are in proportion to the height of the slit meet along their whole length; seen from the side they keep
 * their distance from the eye's axis. */
#include "core/kernel/lids.h"

#include "core/kernel/export.h"
#include "core/tables/generated/mpeg4_tables.h"

/* Lids open beyond neutral by at most this share of the slit, and their gaze is no steeper than this (radians). */
#define WIDEST 0.75F
#define STEEPEST 0.8F
/* A lid keeps this clearance from the ball, as a share of the ball's radius, or what it has on the neutral face if that
 * is less. It gains the difference over the first radians of its way, or of the ball's. */
#define CLEARANCE 0.03F
#define GAIN_OVER 0.1F
/* A vertex slides on its circle while its depth before the axis is more than this share of the circle's radius. */
#define NEAREST 0.05F

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static float clamped(float value, float low, float high) { return value < low ? low : value > high ? high : value; }

void semblante_close_lids(int eye, float pitch, semblante_pose* pose) {
  const semblante_lids* const lids = &pose->lids[eye];
  float* const closure = pose->lid_closure[eye];
  closure[0] = closure[1] = 0.0F;
  if (!(lids->opening > 0.0F)) {
    return;
  }
  float upper = clamped(-pose->fp[SEMBLANTE_UPPER_LID(eye) * 3 + 1] / lids->opening, -WIDEST, 1.0F);
  float lower = clamped(pose->fp[SEMBLANTE_LOWER_LID(eye) * 3 + 1] / lids->opening, -WIDEST, 1.0F);
  if (lids->slit > 0.0F) {
    /* A lid follows the gaze as far as the eye is open. */
    const float gaze = clamped(pitch, -STEEPEST, STEEPEST) / lids->slit;
    const float open = clamped(1.0F - upper - lower, 0.0F, 1.0F);
    upper = clamped(upper + open * lids->gaze_share[0] * gaze, -WIDEST, 1.0F);
    lower = clamped(lower - open * lids->gaze_share[1] * gaze, -WIDEST, 1.0F);
  }
  const float both = upper + lower; /* lids meet and do not cross */
  closure[0] = both > 1.0F ? upper / both : upper;
  closure[1] = both > 1.0F ? lower / both : lower;
}

static int is_zero(const float d[3]) { return d[0] == 0.0F && d[1] == 0.0F && d[2] == 0.0F; }

void semblante_prepare_lid_roll(int eye, const semblante_pose* pose, const semblante_rigid_motion* ball,
                                semblante_lid_roll* roll) {
  const semblante_lids* const lids = &pose->lids[eye];
  roll->lids = lids;
  roll->upper = &pose->fp[SEMBLANTE_UPPER_LID(eye) * 3];
  roll->lower = &pose->fp[SEMBLANTE_LOWER_LID(eye) * 3];
  roll->closure = pose->lid_closure[eye];
  roll->pivot = pose->eye_pivot[eye];
  int ball_moves = 0;
  for (int i = 0; i < 3; ++i) {
    roll->ball_center[i] = pose->eye_pivot[eye][i] + ball->translation[i];
    roll->pole[i] = lids->gaze[i] + dot(ball->change[i], lids->gaze);
    ball_moves |= !is_zero(ball->change[i]) || ball->translation[i] != 0.0F;
  }
  roll->moves = ball_moves || roll->closure[0] != 0.0F || roll->closure[1] != 0.0F || !is_zero(roll->upper) ||
                !is_zero(roll->lower);
}

/* The radius of the ball in the direction of d, a vector of length `distance` from its centre. */
static float radius_towards(const semblante_lids* lids, const float pole[3], const float d[3], float distance) {
  const float at =
      __builtin_sqrtf(1.0F - clamped(dot(d, pole) / distance, 0.0F, 1.0F)) * (float)(SEMBLANTE_BALL_PLACES - 1);
  uint32_t k = (uint32_t)at;
  if (k > SEMBLANTE_BALL_PLACES - 2) {
    k = SEMBLANTE_BALL_PLACES - 2;
  }
  return lids->ball[k] + (at - (float)k) * (lids->ball[k + 1] - lids->ball[k]);
}

/* Moves p away from the ball to the vertex's clearance. `way`: by which its height changes. */
static void clear_ball(const semblante_lid_roll* roll, float way, const float rest[3], float p[3]) {
  const semblante_lids* const lids = roll->lids;
  const float radius = lids->ball[SEMBLANTE_BALL_PLACES - 1];
  const float wanted = CLEARANCE * radius;
  if (!(wanted > 0.0F)) {
    return;
  }
  const float r[3] = {rest[0] - roll->pivot[0], rest[1] - roll->pivot[1], rest[2] - roll->pivot[2]};
  const float d[3] = {p[0] - roll->ball_center[0], p[1] - roll->ball_center[1], p[2] - roll->ball_center[2]};
  const float at_rest = __builtin_sqrtf(dot(r, r));
  const float distance = __builtin_sqrtf(dot(d, d));
  if (!(at_rest > 0.0F) || !(distance > 0.0F)) {
    return;
  }
  float clearance = at_rest - radius_towards(lids, lids->gaze, r, at_rest);
  if (clearance >= wanted) {
    clearance = wanted;
  } else if (clearance > -wanted) { /* what lies deeper on the neutral face is the inside of a lid: hidden */
    const float swing[3] = {roll->pole[0] - lids->gaze[0], roll->pole[1] - lids->gaze[1],
                            roll->pole[2] - lids->gaze[2]};
    const float gained = ((way < 0.0F ? -way : way) / radius + __builtin_sqrtf(dot(swing, swing))) / GAIN_OVER;
    clearance += clamped(gained, 0.0F, 1.0F) * (wanted - clearance);
  }
  const float least = radius_towards(lids, roll->pole, d, distance) + clearance;
  if (distance < least) {
    /* Forwards, so that the height stays that of Eq. 7; at the border of the ball away from its centre. */
    const float square = least * least - d[0] * d[0] - d[1] * d[1];
    if (d[2] > 0.0F && square > 0.25F * least * least) {
      p[2] += __builtin_sqrtf(square) - d[2];
    } else {
      for (int i = 0; i < 3; ++i) {
        p[i] += d[i] * ((least - distance) / distance);
      }
    }
  }
}

void semblante_roll_lid(const semblante_lid_roll* roll, float upper, float lower, const float rest[3], float p[3]) {
  const semblante_lids* const lids = roll->lids;
  const int is_at_rest = p[0] == rest[0] && p[1] == rest[1] && p[2] == rest[2];
  if (!(lids->opening > 0.0F) || (!roll->moves && is_at_rest)) {
    return;
  }
  for (int i = 0; i < 3; ++i) {
    p[i] -= upper * roll->upper[i] + lower * roll->lower[i];
  }
  const float way = lids->opening * (lower * roll->closure[1] - upper * roll->closure[0]);
  const float y = p[1] - roll->pivot[1];
  const float z = p[2] - roll->pivot[2];
  const float least = NEAREST * __builtin_sqrtf(y * y + z * z);
  if (z > least && way != 0.0F) { /* what lies behind the axis does not slide */
    const float square = y * y + z * z - (y + way) * (y + way);
    p[2] += (square > least * least ? __builtin_sqrtf(square) : least) - z;
  }
  p[1] += way;
  clear_ball(roll, way, rest, p);
}

/* Lids roll on the eyeball: a vertex takes the height that the closures of its lids give it by Eq. 7 and slides there
 * on its circle round the eye, in the plane of constant x. Seen from the front lids move as Eq. 7 says, so that rims
 * whose weights are in proportion to the height of the slit meet along their whole length; seen from the side they keep
 * their distance from the eye's axis. */
#include "core/kernel/lids.h"

#define SEMBLANTE_LANES 1
#include "core/kernel/lane_motions.h"
#include "core/tables/generated/mpeg4_tables.h"

/* A FAP of this value moves its point by the whole unit. */
#define FAPU_DIVISOR 1024.0F
/* A lid opens beyond neutral by at most this share of the slit, or until the slit is this wide if that is more
 * (radians): eyes that are closed or hardly open on the neutral face can open. */
#define WIDEST 0.75F
#define WIDEST_SLIT 0.75F
/* ... and no farther than to this angle from the middle of the slit (radians), which lids of people do not reach: of
 * large eyes the gap between lid and eyeball would be seen. */
#define WIDEST_RIM 1.0F
/* The gaze of lids is no steeper than this (radians). */
#define STEEPEST 0.8F
/* A lid keeps this clearance from the ball, as a share of the ball's radius, or what it has on the neutral face if that
 * is less. */
#define CLEARANCE 0.03F

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static float clamped(float value, float low, float high) { return value < low ? low : value > high ? high : value; }

float semblante_unit_at(uint8_t fp, float unit, const semblante_lids lids[2]) {
  for (int eye = 0; eye < 2; ++eye) {
    const float own = lids[eye].opening / FAPU_DIVISOR;
    if ((fp == SEMBLANTE_UPPER_LID(eye) || fp == SEMBLANTE_LOWER_LID(eye)) && own > unit) {
      return own;
    }
  }
  return unit;
}

/* The least closure of a lid: negative, how far it opens beyond neutral. */
static float widest_closure(float slit) {
  if (!(slit > 0.0F)) {
    return -WIDEST;
  }
  if (slit * (1.0F + WIDEST) < WIDEST_SLIT) {
    return 1.0F - WIDEST_SLIT / slit;
  }
  return clamped(0.5F - WIDEST_RIM / slit, -WIDEST, 0.0F);
}

/* How far the points of the lids of an open eye close it, each for itself. Returns the least closure. Inlined: of
 * WebAssembly two copies are smaller than a call when compressed. */
static inline __attribute__((always_inline)) float closure_by_points(int eye, const semblante_pose* pose,
                                                                     float closure[2]) {
  const semblante_lids* const lids = &pose->lids[eye];
  const float widest = widest_closure(lids->slit);
  closure[0] = clamped(-pose->fp[SEMBLANTE_UPPER_LID(eye) * 3 + 1] / lids->opening, widest, 1.0F);
  closure[1] = clamped(pose->fp[SEMBLANTE_LOWER_LID(eye) * 3 + 1] / lids->opening, widest, 1.0F);
  return widest;
}

void semblante_stop_lids(int eye, float pitch, semblante_pose* pose) {
  const semblante_lids* const lids = &pose->lids[eye];
  const float opening = lids->opening;
  if (!(opening > 0.0F)) {
    return;
  }
  float* const upper_y = &pose->fp[SEMBLANTE_UPPER_LID(eye) * 3 + 1];
  float* const lower_y = &pose->fp[SEMBLANTE_LOWER_LID(eye) * 3 + 1];
  *upper_y = *upper_y < -opening ? -opening : *upper_y;
  *lower_y = *lower_y > opening ? opening : *lower_y;
  if (!(lids->slit > 0.0F)) {
    return;
  }
  float closure[2];
  const float widest = closure_by_points(eye, pose, closure);
  /* A lid follows the gaze as far as the eye is open. */
  const float open = clamped(1.0F - closure[0] - closure[1], 0.0F, 1.0F);
  const float gaze = open * clamped(pitch, -STEEPEST, STEEPEST) / lids->slit;
  *upper_y += opening * (closure[0] - clamped(closure[0] + lids->gaze_share[0] * gaze, widest, 1.0F));
  *lower_y += opening * (clamped(closure[1] - lids->gaze_share[1] * gaze, widest, 1.0F) - closure[1]);
}

void semblante_close_lids(int eye, semblante_pose* pose) {
  float* const closure = pose->lid_closure[eye];
  closure[0] = closure[1] = 0.0F;
  if (!(pose->lids[eye].opening > 0.0F)) {
    return;
  }
  closure_by_points(eye, pose, closure);
  const float both = closure[0] + closure[1]; /* lids meet and do not cross */
  if (both > 1.0F) {
    closure[0] /= both;
    closure[1] /= both;
  }
}

float semblante_clearance_at_rest(const semblante_lids* lids, const float pivot[3], const float rest[3]) {
  return clearance_at_rest(lids, pivot, rest);
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
  const float swing[3] = {roll->pole[0] - lids->gaze[0], roll->pole[1] - lids->gaze[1], roll->pole[2] - lids->gaze[2]};
  roll->swing = __builtin_sqrtf(dot(swing, swing));
  roll->gain = 1.0F / (lids->ball[SEMBLANTE_BALL_PLACES - 1] * SEMBLANTE_LID_GAIN_OVER);
  roll->gained = roll->swing / SEMBLANTE_LID_GAIN_OVER;
  roll->clearance = CLEARANCE * lids->ball[SEMBLANTE_BALL_PLACES - 1];
  float largest = 0.0F;
  for (uint32_t k = 0; k < SEMBLANTE_BALL_PLACES; ++k) {
    largest = lids->ball[k] > largest ? lids->ball[k] : largest;
  }
  const float reach = 1.001F * (largest + roll->clearance + lids->lift * lids->opening); /* more than any rounding */
  roll->square_reach = reach * reach;
  roll->moves = ball_moves || roll->closure[0] != 0.0F || roll->closure[1] != 0.0F || !is_zero(roll->upper) ||
                !is_zero(roll->lower);
}

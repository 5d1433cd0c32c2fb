/* Eq. 5, 6 and 7 of the paper; see semblante_kernel.h for the contract. */
#include "core/kernel/semblante_kernel.h"

#include <stddef.h>

#include "core/tables/generated/mpeg4_tables.h"

#if defined(__wasm__)
#define SEMBLANTE_EXPORT(name) __attribute__((export_name(#name)))
/* JavaScript lays these structs out by hand (offsets in README.md): they may not move. */
_Static_assert(sizeof(semblante_frame) == 284 && offsetof(semblante_frame, fap) == 8, "frame");
_Static_assert(sizeof(semblante_rig) == 68 && offsetof(semblante_rig, viseme_share) == 64, "rig");
_Static_assert(sizeof(semblante_pose) == 1116 && offsetof(semblante_pose, eye_rotation) == 1008, "pose");
_Static_assert(sizeof(semblante_face) == 24, "face");
#else
#define SEMBLANTE_EXPORT(name)
#endif

/* Four lanes, three used: one multiply-add per influence. Lanes are independent, so the bits do not depend on it. */
typedef float lanes __attribute__((vector_size(16)));

/* ---- rotations ------------------------------------------------------------------------------------------------ */

#define AU_RADIANS 1e-5F

SEMBLANTE_EXPORT(semblante_sincos)
void semblante_sincos(float angle, float* sine, float* cosine) {
  *sine = 0.0F;
  *cosine = 1.0F;
  if (!(angle > -1e6F && angle < 1e6F)) {
    return; /* not an angle a face can have; also NaN */
  }
  /* Quarter turns off, then Taylor about 0 on [-pi/4, pi/4]: the first terms left out are below 4e-10. */
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

/* q = turn about one axis (0 x, 1 y, 2 z) by `value` AU, then the turn that q was: q = axis_turn * q. */
static void turn_after(float q[4], int axis, float value) {
  float r[4] = {0.0F, 0.0F, 0.0F, 1.0F};
  semblante_sincos(0.5F * value * AU_RADIANS, &r[axis], &r[3]);
  const float x = r[3] * q[0] + r[0] * q[3] + r[1] * q[2] - r[2] * q[1];
  const float y = r[3] * q[1] + r[1] * q[3] + r[2] * q[0] - r[0] * q[2];
  const float z = r[3] * q[2] + r[2] * q[3] + r[0] * q[1] - r[1] * q[0];
  const float w = r[3] * q[3] - r[0] * q[0] - r[1] * q[1] - r[2] * q[2];
  q[0] = x, q[1] = y, q[2] = z, q[3] = w;
}

static void set_identity(float q[4]) { q[0] = q[1] = q[2] = 0.0F, q[3] = 1.0F; }

/* x += (R - 1)(x - pivot) + translation. Written as a change of x, so that no rotation means no change at all, not
 * even of the last bit. */
typedef struct motion {
  float change[3][3]; /* R - 1 */
  float pivot[3];
  float translation[3];
} motion;

static motion motion_of(const float q[4], const float pivot[3], const float translation[3]) {
  const float x = q[0];
  const float y = q[1];
  const float z = q[2];
  const float w = q[3];
  const motion m = {{{-2.0F * (y * y + z * z), 2.0F * (x * y - w * z), 2.0F * (x * z + w * y)},
                     {2.0F * (x * y + w * z), -2.0F * (x * x + z * z), 2.0F * (y * z - w * x)},
                     {2.0F * (x * z - w * y), 2.0F * (y * z + w * x), -2.0F * (x * x + y * y)}},
                    {pivot[0], pivot[1], pivot[2]},
                    {translation[0], translation[1], translation[2]}};
  return m;
}

static void move(const motion* m, float p[3]) {
  const float d[3] = {p[0] - m->pivot[0], p[1] - m->pivot[1], p[2] - m->pivot[2]};
  for (int i = 0; i < 3; ++i) {
    p[i] += (m->change[i][0] * d[0] + m->change[i][1] * d[1] + m->change[i][2] * d[2]) + m->translation[i];
  }
}

/* ---- frame -> pose -------------------------------------------------------------------------------------------- */

/* Weighted sum of two entries of a table of displacement sets at one FP. Entries out of range count as zero. */
static void blend(const float* table, uint32_t count, uint32_t entry1, float weight1, uint32_t entry2, float weight2,
                  uint32_t fp, float out[3]) {
  out[0] = out[1] = out[2] = 0.0F;
  if (table == NULL) {
    return;
  }
  for (uint32_t i = 0; i < 3; ++i) {
    const uint32_t component = fp * 3 + i;
    if (entry1 < count) {
      out[i] += weight1 * table[entry1 * SEMBLANTE_FP_COUNT * 3 + component];
    }
    if (entry2 < count) {
      out[i] += weight2 * table[entry2 * SEMBLANTE_FP_COUNT * 3 + component];
    }
  }
}

static float share_of_63(uint8_t value) {
  return (value < SEMBLANTE_BLEND_MAX ? (float)value : (float)SEMBLANTE_BLEND_MAX) / (float)SEMBLANTE_BLEND_MAX;
}

static int moves(const float d[3]) { return d[0] != 0.0F || d[1] != 0.0F || d[2] != 0.0F; }

/* Eq. 5: visemes and expressions. */
static void evaluate_high_level(const semblante_rig* rig, const semblante_frame* frame, float* fp_displacements) {
  const float viseme_weight = share_of_63(frame->viseme_blend);
  for (uint32_t fp = 0; fp < SEMBLANTE_FP_COUNT; ++fp) {
    float viseme[3];
    float expression[3];
    blend(rig->viseme, SEMBLANTE_VISEME_COUNT, frame->viseme1, viseme_weight, frame->viseme2, 1.0F - viseme_weight, fp,
          viseme);
    blend(rig->expression, SEMBLANTE_EXPRESSION_COUNT, frame->expression1, share_of_63(frame->intensity1),
          frame->expression2, share_of_63(frame->intensity2), fp, expression);
    const int both = moves(viseme) && moves(expression);
    const float viseme_share = both ? rig->viseme_share : 1.0F;
    const float expression_share = both ? 1.0F - rig->viseme_share : 1.0F;
    for (uint32_t i = 0; i < 3; ++i) {
      fp_displacements[fp * 3 + i] = viseme_share * viseme[i] + expression_share * expression[i];
    }
  }
}

/* Which rigid part a FAP of this FP turns: 0, 1 the eyes, 2 the head. */
static int rigid_part_of(uint8_t fp) {
  return fp == SEMBLANTE_FP_LEFT_PUPIL ? 0 : fp == SEMBLANTE_FP_RIGHT_PUPIL ? 1 : 2;
}

SEMBLANTE_EXPORT(semblante_evaluate)
void semblante_evaluate(const semblante_rig* rig, const semblante_frame* frame, semblante_pose* pose) {
  evaluate_high_level(rig, frame, pose->fp);

  float* const rotation[3] = {pose->eye_rotation[0], pose->eye_rotation[1], pose->head_rotation};
  float angle[3][3] = {{0}}; /* AU, part by axis */
  for (int i = 0; i < 3; ++i) {
    pose->eye_translation[0][i] = 0.0F;
    pose->eye_translation[1][i] = 0.0F;
    pose->eye_pivot[0][i] = rig->eye_pivot[0][i];
    pose->eye_pivot[1][i] = rig->eye_pivot[1][i];
    pose->head_pivot[i] = rig->head_pivot[i];
  }

  for (uint32_t n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) {
    const semblante_fap_entry* fap = &semblante_fap_table[n];
    const float value = frame->fap[n];
    if (value == 0.0F) {
      continue;
    }
    if (fap->kind == SEMBLANTE_FAP_ROTATION) {
      angle[rigid_part_of(fap->fp)][fap->axis] = (float)fap->sign * value;
    } else if (fap->kind == SEMBLANTE_FAP_TRANSLATION && rig->fapu[fap->unit] != 0.0F) {
      /* Eq. 6. An eyeball is thrust as a whole; every other FAP moves its point. */
      const float displacement = (float)fap->sign * value * rig->fapu[fap->unit];
      const int eye = fap->fp == SEMBLANTE_FP_LEFT_PUPIL || fap->fp == SEMBLANTE_FP_RIGHT_PUPIL;
      float* const target = eye ? pose->eye_translation[rigid_part_of(fap->fp)] : &pose->fp[(size_t)fap->fp * 3];
      target[fap->axis] = displacement;
    }
  }

  for (int part = 0; part < 3; ++part) {
    set_identity(rotation[part]);
    turn_after(rotation[part], 2, angle[part][2]); /* roll */
    turn_after(rotation[part], 0, angle[part][0]); /* pitch */
    turn_after(rotation[part], 1, angle[part][1]); /* yaw */
  }
}

/* ---- between poses -------------------------------------------------------------------------------------------- */

static float lerp(float a, float b, float t) { return a + t * (b - a); }

/* Normalized linear interpolation: frames are close in time, where it equals the great arc to the eye. */
static void interpolate_rotation(const float a[4], const float b[4], float t, float out[4]) {
  const float dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const float side = dot < 0.0F ? -1.0F : 1.0F; /* q and -q are one rotation: take the nearer */
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
      out->eye_pivot[eye][i] = lerp(a->eye_pivot[eye][i], b->eye_pivot[eye][i], t);
    }
    out->head_pivot[i] = lerp(a->head_pivot[i], b->head_pivot[i], t);
  }
  interpolate_rotation(a->eye_rotation[0], b->eye_rotation[0], t, out->eye_rotation[0]);
  interpolate_rotation(a->eye_rotation[1], b->eye_rotation[1], t, out->eye_rotation[1]);
  interpolate_rotation(a->head_rotation, b->head_rotation, t, out->head_rotation);
}

/* ---- pose -> vertices ----------------------------------------------------------------------------------------- */

SEMBLANTE_EXPORT(semblante_deform)
void semblante_deform(const semblante_face* face, const semblante_pose* pose, float* positions) {
  static const float still[3] = {0.0F, 0.0F, 0.0F};
  const motion head = motion_of(pose->head_rotation, pose->head_pivot, still);
  const motion eyes[2] = {motion_of(pose->eye_rotation[0], pose->eye_pivot[0], pose->eye_translation[0]),
                          motion_of(pose->eye_rotation[1], pose->eye_pivot[1], pose->eye_translation[1])};
  lanes displacement[SEMBLANTE_FP_COUNT];
  for (uint32_t i = 0; i < SEMBLANTE_FP_COUNT; ++i) {
    const float* const d = &pose->fp[(size_t)i * 3];
    displacement[i] = (lanes){d[0], d[1], d[2], 0.0F};
  }

  uint32_t entry = face->row_offsets[0];
  const float* rest = face->rest;
  for (uint32_t v = 0; v < face->vertex_count; ++v) {
    /* Eq. 7: D_P = sum of (W_iP / sum of W) D_i; an empty row stays where it is. */
    lanes d = {0.0F, 0.0F, 0.0F, 0.0F};
    for (const uint32_t end = face->row_offsets[v + 1]; entry < end; ++entry) {
      d += face->row_weights[entry] * displacement[face->row_points[entry]];
    }
    float p[3] = {rest[0] + d[0], rest[1] + d[1], rest[2] + d[2]};
    if (face->rigid != NULL && face->rigid[v] != SEMBLANTE_RIGID_NONE) {
      move(&eyes[face->rigid[v] - SEMBLANTE_RIGID_LEFT_EYE], p);
    }
    move(&head, p);
    positions[0] = p[0];
    positions[1] = p[1];
    positions[2] = p[2];
    rest += 3;
    positions += 3;
  }
}

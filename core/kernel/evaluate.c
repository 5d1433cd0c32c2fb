/* Frame -> pose: Eq. 5 (visemes and expressions), Eq. 6 (low-level FAPs) and the rotations of eyes and head. */
#include <stddef.h>

#include "core/kernel/companions.h"
#include "core/kernel/export.h"
#include "core/kernel/lids.h"
#include "core/kernel/rotation.h"
#include "core/kernel/semblante_kernel.h"
#include "core/tables/generated/mpeg4_tables.h"

#if defined(__wasm__)
/* JavaScript uses fixed offsets of these structs (README.md): they must not change. */
_Static_assert(sizeof(semblante_frame) == 284 && offsetof(semblante_frame, fap) == 8, "frame");
_Static_assert(sizeof(semblante_iris) == 24 && sizeof(semblante_tongue) == 44, "iris, tongue");
_Static_assert(sizeof(semblante_lids) == 100 && sizeof(semblante_companion) == 8, "lids, companion");
_Static_assert(sizeof(semblante_rig) == 372 && offsetof(semblante_rig, lids) == 172, "rig");
_Static_assert(sizeof(semblante_pose) == 1436 && offsetof(semblante_pose, lid_closure) == 1220, "pose");
#endif

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

static float clamped(float value, float low, float high) { return value < low ? low : value > high ? high : value; }

/* FAPs 29 and 30. A minimal ring of iris and a minimal pupil remain, so that no triangle flips. */
static float pupil_growth(const semblante_iris* iris, float diameter_growth) {
  const float kept = 0.9F;
  return clamped(0.5F * diameter_growth, -kept * iris->pupil_radius, kept * (iris->iris_radius - iris->pupil_radius));
}

/* The rigid part that a FAP of this FP rotates: 0, 1 the eyes, 2 the head. */
static int rigid_part_of(uint8_t fp) {
  return fp == SEMBLANTE_FP_LEFT_PUPIL ? 0 : fp == SEMBLANTE_FP_RIGHT_PUPIL ? 1 : 2;
}

SEMBLANTE_EXPORT(semblante_evaluate)
void semblante_evaluate(const semblante_rig* rig, const semblante_frame* frame, semblante_pose* pose) {
  evaluate_high_level(rig, frame, pose->fp);
  float set[SEMBLANTE_FP_COUNT * 3];
  uint8_t own[SEMBLANTE_FP_COUNT] = {0};
  for (uint32_t i = 0; i < SEMBLANTE_FP_COUNT * 3; ++i) {
    set[i] = pose->fp[i];
  }

  float* const rotation[3] = {pose->eye_rotation[0], pose->eye_rotation[1], pose->head_rotation};
  float angle[3][3] = {{0}}; /* AU; by part and axis */
  for (int i = 0; i < 3; ++i) {
    pose->eye_translation[0][i] = 0.0F;
    pose->eye_translation[1][i] = 0.0F;
    pose->eye_pivot[0][i] = rig->eye_pivot[0][i];
    pose->eye_pivot[1][i] = rig->eye_pivot[1][i];
    pose->head_pivot[i] = rig->head_pivot[i];
  }
  for (int eye = 0; eye < 2; ++eye) {
    pose->iris[eye] = rig->iris[eye];
    pose->pupil_growth[eye] = 0.0F;
    pose->lids[eye] = rig->lids[eye];
  }
  pose->tongue = rig->tongue;
  pose->tongue_roll = 0.0F;

  for (uint32_t n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) {
    const semblante_fap_entry* fap = &semblante_fap_table[n];
    const float value = frame->fap[n];
    if (value == 0.0F) {
      continue;
    }
    if (fap->kind == SEMBLANTE_FAP_ROTATION) {
      angle[rigid_part_of(fap->fp)][fap->axis] = (float)fap->sign * value;
    } else if (fap->kind == SEMBLANTE_FAP_PUPIL) {
      const int eye = rigid_part_of(fap->fp);
      pose->pupil_growth[eye] = pupil_growth(&rig->iris[eye], value * rig->fapu[fap->unit]);
    } else if (fap->kind == SEMBLANTE_FAP_ROLL) {
      pose->tongue_roll = clamped(value * SEMBLANTE_AU_RADIANS, -rig->tongue.roll_limit, rig->tongue.roll_limit);
    } else if (fap->kind == SEMBLANTE_FAP_TRANSLATION && rig->fapu[fap->unit] != 0.0F) {
      /* Eq. 6. A thrust moves the whole eyeball; every other FAP moves its point. */
      const float displacement = (float)fap->sign * value * semblante_unit_at(fap->fp, rig->fapu[fap->unit], rig->lids);
      const int eye = fap->fp == SEMBLANTE_FP_LEFT_PUPIL || fap->fp == SEMBLANTE_FP_RIGHT_PUPIL;
      float* const target = eye ? pose->eye_translation[rigid_part_of(fap->fp)] : &pose->fp[(size_t)fap->fp * 3];
      target[fap->axis] = displacement;
      own[fap->fp] |= (uint8_t)(1U << fap->axis);
    }
  }

  for (int eye = 0; eye < 2; ++eye) {
    semblante_stop_lids(eye, angle[eye][0] * SEMBLANTE_AU_RADIANS, pose);
  }
  semblante_move_companions(rig, set, own, pose->fp);
  for (int eye = 0; eye < 2; ++eye) {
    semblante_close_lids(eye, pose);
  }

  for (int part = 0; part < 3; ++part) {
    rotation[part][0] = rotation[part][1] = rotation[part][2] = 0.0F;
    rotation[part][3] = 1.0F;
    semblante_turn_after(rotation[part], 2, angle[part][2]); /* roll */
    semblante_turn_after(rotation[part], 0, angle[part][0]); /* pitch */
    semblante_turn_after(rotation[part], 1, angle[part][1]); /* yaw */
  }
}

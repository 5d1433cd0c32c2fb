/* Pose -> vertices of a prepared face, with the widest registers of the machine. */
#include "core/kernel/export.h"
#include "core/kernel/prepared_layout.h"

const semblante_deform_variant* semblante_deform_variants(uint32_t* count) {
  static const semblante_deform_variant variants[] = {
#if defined(__aarch64__)
    {"NEON", 8, semblante_deform_groups_plain},
#elif defined(__wasm_simd128__)
    {"SIMD128", 8, semblante_deform_groups_plain},
#elif defined(__SSE2__)
    {"SSE2", 8, semblante_deform_groups_plain},
#else
    {"plain", 8, semblante_deform_groups_plain},
#endif
#if defined(__x86_64__)
    {"AVX2", 8, semblante_deform_groups_avx2},
    {"AVX-512", 16, semblante_deform_groups_avx512},
#endif
  };
  *count = sizeof variants / sizeof variants[0];
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") == 0) {
    --*count;
    if (__builtin_cpu_supports("avx2") == 0) {
      --*count;
    }
  }
#endif
  return variants;
}

static int differ(const float* a, const float* b, uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) {
    if (a[i] != b[i]) {
      return 1;
    }
  }
  return 0;
}

static void prepare_pose(const semblante_prepared_face* face, const semblante_pose* pose, semblante_group_pose* out) {
  static const float still[3] = {0.0F, 0.0F, 0.0F};
  for (uint32_t fp = 0; fp < SEMBLANTE_FP_COUNT; ++fp) {
    for (uint32_t i = 0; i < 3; ++i) {
      out->fp[fp][i] = pose->fp[fp * 3 + i];
    }
    out->fp[fp][3] = 0.0F;
  }
  out->head = semblante_rigid_motion_of(pose->head_rotation, pose->head_pivot, still);
  static const float none[9] = {0.0F};
  out->head_moves = differ(&out->head.change[0][0], none, 9);
  out->head_rotation = pose->head_rotation;
  semblante_prepare_local(pose, &out->local);
  for (uint32_t eye = 0; eye < 2; ++eye) {
    out->eye_moves[eye] =
        differ(&out->local.eye[eye].change[0][0], none, 9) || differ(out->local.eye[eye].translation, none, 3);
    out->iris_moves[eye] = pose->pupil_growth[eye] != 0.0F;
    out->knows_clearance[eye] = !differ(pose->lids[eye].gaze, face->lids_of_rig[eye].gaze, 3) &&
                                !differ(pose->lids[eye].ball, face->lids_of_rig[eye].ball, SEMBLANTE_BALL_PLACES) &&
                                !differ(pose->eye_pivot[eye], face->eye_pivot[eye], 3);
  }
  out->tongue_moves = pose->tongue_roll != 0.0F;
  out->changed_points = NULL;
  out->head_changed = 0;
  out->local_changed = 0;
}

void semblante_deform_by(const semblante_deform_variant* variant, const semblante_prepared_face* face,
                         const semblante_pose* pose, float* positions) {
  semblante_group_pose prepared;
  prepare_pose(face, pose, &prepared);
  variant->run(face, &prepared, positions);
}

/* The fastest variant for the groups of a face. */
static semblante_deform_groups best(const semblante_prepared_face* face) {
  uint32_t count = 0;
  const semblante_deform_variant* const variants = semblante_deform_variants(&count);
  while (variants[count - 1].group_size != face->group_size) {
    --count;
  }
  return variants[count - 1].run;
}

SEMBLANTE_EXPORT(semblante_deform_prepared)
void semblante_deform_prepared(const semblante_prepared_face* face, const semblante_pose* pose, float* positions) {
  semblante_group_pose prepared;
  prepare_pose(face, pose, &prepared);
  best(face)(face, &prepared, positions);
}

/* Whether eyes, pupils, lids or tongue differ, that is, all members of a pose except the points and the head. */
static int parts_differ(const semblante_pose* a, const semblante_pose* b) {
  return differ(&a->eye_rotation[0][0], &b->eye_rotation[0][0], 8) ||
         differ(&a->eye_translation[0][0], &b->eye_translation[0][0], 6) ||
         differ(&a->eye_pivot[0][0], &b->eye_pivot[0][0], 6) || differ(a->pupil_growth, b->pupil_growth, 2) ||
         a->tongue_roll != b->tongue_roll ||
         differ(&a->iris[0].axis[0], &b->iris[0].axis[0], sizeof a->iris / (sizeof(float))) ||
         differ(a->tongue.origin, b->tongue.origin, sizeof a->tongue / (sizeof(float))) ||
         differ(&a->lid_closure[0][0], &b->lid_closure[0][0], (sizeof a->lid_closure + sizeof a->lids) / sizeof(float));
}

SEMBLANTE_EXPORT(semblante_deform_changed)
uint32_t semblante_deform_changed(const semblante_prepared_face* face, const semblante_pose* before,
                                  const semblante_pose* now, float* positions) {
  semblante_group_pose prepared;
  semblante_group_pose previous;
  prepare_pose(face, now, &prepared);
  prepare_pose(face, before, &previous);
  uint8_t changed[SEMBLANTE_FP_COUNT];
  for (uint32_t fp = 0; fp < SEMBLANTE_FP_COUNT; ++fp) {
    changed[fp] = (uint8_t)differ(prepared.fp[fp], previous.fp[fp], 3);
  }
  prepared.changed_points = changed;
  prepared.head_changed = differ(&prepared.head.change[0][0], &previous.head.change[0][0], 9) ||
                          (prepared.head_moves && differ(prepared.head.pivot, previous.head.pivot, 3));
  prepared.local_changed = parts_differ(before, now);
  return best(face)(face, &prepared, positions);
}

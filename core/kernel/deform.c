/* Pose -> vertices: Eq. 7 for all vertices, then the local motions of eyes, irises, lids and tongue, then the head's
 * motion.
 */
#include <stddef.h>

#include "core/kernel/export.h"
#define SEMBLANTE_LANES 1
#include "core/kernel/lane_motions.h"
#include "core/kernel/semblante_kernel.h"
#include "core/tables/generated/mpeg4_tables.h"

#if defined(__wasm__)
/* JavaScript uses fixed offsets of this struct (README.md): they must not change. */
_Static_assert(sizeof(semblante_face) == 28, "face");
#endif

/* Four lanes, three used: one multiply-add per influence. Lanes are independent, so the bits do not depend on it. */
typedef float lanes __attribute__((vector_size(16)));

/* The weight of a point in the row of a vertex; 0 if the row does not have it. */
static float weight_of(const semblante_face* face, uint32_t v, uint32_t point) {
  for (uint32_t k = face->row_offsets[v]; k < face->row_offsets[v + 1]; ++k) {
    if (face->row_points[k] == point) {
      return face->row_weights[k];
    }
  }
  return 0.0F;
}

/* The motion of a vertex of an eye, iris, lid or the tongue. */
static void move_part(const semblante_local_motions* local, const semblante_face* face, uint32_t v, const float* rest,
                      float p[3]) {
  const semblante_pose* const pose = local->pose;
  const uint8_t rigid = face->rigid[v];
  if (rigid >= SEMBLANTE_RIGID_TONGUE) {
    semblante_roll_tongue(pose, rigid, rest, p);
    return;
  }
  for (int eye = 0; eye < 2; ++eye) {
    if (rigid == SEMBLANTE_RIGID_LEFT_LIDS + eye) {
      const float upper = weight_of(face, v, SEMBLANTE_UPPER_LID(eye));
      const float lower = weight_of(face, v, SEMBLANTE_LOWER_LID(eye));
      float way = 0.0F;
      if (roll_lids(&local->lids[eye], 1, upper, lower, rest, p, &way)) {
        clear_ball(&local->lids[eye], 1, way, rest, NULL, p);
      }
    }
    if (rigid == SEMBLANTE_RIGID_LEFT_IRIS + eye) {
      move_iris(&pose->iris[eye], pose->eye_pivot[eye], pose->pupil_growth[eye], rest, p);
    }
    if (rigid == SEMBLANTE_RIGID_LEFT_EYE + eye || rigid == SEMBLANTE_RIGID_LEFT_IRIS + eye) {
      move_rigidly(&local->eye[eye], 1, p);
    }
  }
}

SEMBLANTE_EXPORT(semblante_deform)
void semblante_deform(const semblante_face* face, const semblante_pose* pose, float* positions) {
  static const float still[3] = {0.0F, 0.0F, 0.0F};
  const semblante_rigid_motion head = semblante_rigid_motion_of(pose->head_rotation, pose->head_pivot, still);
  semblante_local_motions local;
  semblante_prepare_local(pose, &local);
  lanes displacement[SEMBLANTE_FP_COUNT];
  for (uint32_t i = 0; i < SEMBLANTE_FP_COUNT; ++i) {
    const float* const d = &pose->fp[(size_t)i * 3];
    displacement[i] = (lanes){d[0], d[1], d[2], 0.0F};
  }

  uint32_t entry = face->row_offsets[0];
  const float* rest = face->rest;
  for (uint32_t v = 0; v < face->vertex_count; ++v) {
    /* Eq. 7: D_P = sum of (W_iP / sum of W) D_i; a vertex with an empty row keeps its position. */
    lanes d = {0.0F, 0.0F, 0.0F, 0.0F};
    for (const uint32_t end = face->row_offsets[v + 1]; entry < end; ++entry) {
      d += face->row_weights[entry] * displacement[face->row_points[entry]];
    }
    float p[3] = {rest[0] + d[0], rest[1] + d[1], rest[2] + d[2]};
    if (face->rigid != NULL && face->rigid[v] != SEMBLANTE_RIGID_NONE) {
      move_part(&local, face, v, rest, p);
    }
    const uint8_t turn = face->turn == NULL ? SEMBLANTE_TURN_FULL : face->turn[v];
    if (turn == SEMBLANTE_TURN_FULL) {
      move_rigidly(&head, 0, p);
    } else if (turn != 0) {
      turn_partly(pose->head_rotation, pose->head_pivot, turn, p);
    }
    positions[0] = p[0];
    positions[1] = p[1];
    positions[2] = p[2];
    rest += 3;
    positions += 3;
  }
}

/* Pose -> vertices: Eq. 7 for all vertices, then the local motions of eyes, irises, lids and tongue, then the head's
 * motion.
 */
#include <stddef.h>

#include "core/kernel/export.h"
#include "core/kernel/head_motion.h"
#include "core/kernel/local_motion.h"
#include "core/kernel/rigid_motion.h"
#include "core/kernel/semblante_kernel.h"
#include "core/tables/generated/mpeg4_tables.h"

#if defined(__wasm__)
/* JavaScript uses fixed offsets of this struct (README.md): they must not change. */
_Static_assert(sizeof(semblante_face) == 28, "face");
#endif

/* Four lanes, three used: one multiply-add per influence. Lanes are independent, so the bits do not depend on it. */
typedef float lanes __attribute__((vector_size(16)));

/* The weights of the lids' points in the row of a vertex. */
static semblante_lid_weights lid_weights(const semblante_face* face, uint32_t v) {
  semblante_lid_weights weights = {0.0F, 0.0F};
  const int eye = semblante_lids_of(face->rigid[v]);
  for (uint32_t k = face->row_offsets[v]; eye >= 0 && k < face->row_offsets[v + 1]; ++k) {
    if (face->row_points[k] == SEMBLANTE_UPPER_LID(eye)) {
      weights.upper = face->row_weights[k];
    } else if (face->row_points[k] == SEMBLANTE_LOWER_LID(eye)) {
      weights.lower = face->row_weights[k];
    }
  }
  return weights;
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
      semblante_move_local(&local, face->rigid[v], lid_weights(face, v), rest, p);
    }
    const uint8_t turn = face->turn == NULL ? SEMBLANTE_TURN_FULL : face->turn[v];
    if (turn == SEMBLANTE_TURN_FULL) {
      semblante_move(&head, p);
    } else if (turn != 0) {
      const semblante_rigid_motion part = semblante_part_of_turn(pose->head_rotation, pose->head_pivot, turn);
      semblante_move(&part, p);
    }
    positions[0] = p[0];
    positions[1] = p[1];
    positions[2] = p[2];
    rest += 3;
    positions += 3;
  }
}

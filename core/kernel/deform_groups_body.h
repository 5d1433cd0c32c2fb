/* Internal: Eq. 7, local motions and the head's motion for groups of eight vertices. The including file defines
 * SEMBLANTE_LANES, the number of floats per register (4 or 8), and SEMBLANTE_DEFORM_GROUPS, the name of the function.
 * Every lane adds the same terms as semblante_deform in the same order, so that all variants are bit-identical to it.
 */
#include "core/kernel/head_motion.h"
#include "core/kernel/prepared_layout.h"
#include "core/tables/generated/mpeg4_tables.h"

#if SEMBLANTE_LANES == 8
#include <immintrin.h>
#endif

#define REGISTERS (SEMBLANTE_GROUP / SEMBLANTE_LANES) /* registers per coordinate of a group */

typedef float reg __attribute__((vector_size(4 * SEMBLANTE_LANES)));
/* For the caller's floats: only 4-byte alignment, and may alias other types. */
typedef float loose_quad __attribute__((vector_size(16), aligned(4), may_alias));
typedef float quad __attribute__((vector_size(16)));

/* Stores x, y, z of four (or eight) vertices as x y z x y z ... All shuffles stay within 128-bit lanes, so that each is
 * one instruction on every machine. */
static inline __attribute__((always_inline)) void store_rows(reg x, reg y, reg z, float* to) {
#if SEMBLANTE_LANES == 8
  const reg xy = __builtin_shufflevector(x, y, 0, 2, 8, 10, 4, 6, 12, 14);
  const reg yz = __builtin_shufflevector(y, z, 1, 3, 9, 11, 5, 7, 13, 15);
  const reg zx = __builtin_shufflevector(z, x, 0, 2, 9, 11, 4, 6, 13, 15);
  const reg a = __builtin_shufflevector(xy, zx, 0, 2, 8, 10, 4, 6, 12, 14);
  const reg b = __builtin_shufflevector(yz, xy, 0, 2, 9, 11, 4, 6, 13, 15);
  const reg c = __builtin_shufflevector(zx, yz, 1, 3, 9, 11, 5, 7, 13, 15);
  *(loose_quad*)(to + 0) = __builtin_shufflevector(a, a, 0, 1, 2, 3);
  *(loose_quad*)(to + 4) = __builtin_shufflevector(b, b, 0, 1, 2, 3);
  *(loose_quad*)(to + 8) = __builtin_shufflevector(c, c, 0, 1, 2, 3);
  /* Intrinsics, because a built-in shuffle would need an additional register. */
  _mm_storeu_ps(to + 12, _mm256_extractf128_ps((__m256)a, 1));
  _mm_storeu_ps(to + 16, _mm256_extractf128_ps((__m256)b, 1));
  _mm_storeu_ps(to + 20, _mm256_extractf128_ps((__m256)c, 1));
#else
  const reg xy = __builtin_shufflevector(x, y, 0, 2, 4, 6);
  const reg yz = __builtin_shufflevector(y, z, 1, 3, 5, 7);
  const reg zx = __builtin_shufflevector(z, x, 0, 2, 5, 7);
  *(loose_quad*)(to + 0) = __builtin_shufflevector(xy, zx, 0, 2, 4, 6);
  *(loose_quad*)(to + 4) = __builtin_shufflevector(yz, xy, 0, 2, 5, 7);
  *(loose_quad*)(to + 8) = __builtin_shufflevector(zx, yz, 1, 3, 5, 7);
#endif
}

/* semblante_move with one vertex per lane. `slides`: the motion may have a translation. */
static inline __attribute__((always_inline)) void move_registers(const semblante_rigid_motion* m, int slides,
                                                                 reg p[3]) {
  const reg d[3] = {p[0] - m->pivot[0], p[1] - m->pivot[1], p[2] - m->pivot[2]};
  for (int i = 0; i < 3; ++i) {
    const reg turned = m->change[i][0] * d[0] + m->change[i][1] * d[1] + m->change[i][2] * d[2];
    p[i] += slides ? turned + m->translation[i] : turned;
  }
}

/* The current position in the arrays of the prepared face. */
typedef struct cursor {
  const reg* rest;
  const reg* weights;
  const uint8_t* points;
  const uint32_t* first;
  uint32_t written;
} cursor;

/* The points of one group and their weights, eight for each point. */
typedef struct group_row {
  const uint8_t* points;
  const float* weights;
  uint32_t count;
} group_row;

/* The weights that one vertex of a group has of the points of its lids. */
static semblante_lid_weights lid_weights(const group_row* row, uint32_t lane, uint8_t rigid) {
  semblante_lid_weights weights = {0.0F, 0.0F};
  const int eye = semblante_lids_of(rigid);
  for (uint32_t k = 0; eye >= 0 && k < row->count; ++k) {
    if (row->points[k] == SEMBLANTE_UPPER_LID(eye)) {
      weights.upper = row->weights[k * SEMBLANTE_GROUP + lane];
    } else if (row->points[k] == SEMBLANTE_LOWER_LID(eye)) {
      weights.lower = row->weights[k * SEMBLANTE_GROUP + lane];
    }
  }
  return weights;
}

/* Local motions and the head's vertex by vertex, for groups with different motions and for an incomplete last group. */
static __attribute__((noinline)) void finish_by_vertex(const semblante_prepared_face* face,
                                                       const semblante_group_pose* pose, const group_row* row,
                                                       const float* rest, uint32_t first, const float* moved,
                                                       float* to) {
  const uint8_t* const rigid = face->rigid + first;
  const uint32_t left = face->vertex_count - first;
  const uint32_t count = left < SEMBLANTE_GROUP ? left : SEMBLANTE_GROUP;
  for (uint32_t v = 0; v < count; ++v) {
    float p[3] = {moved[v * 3], moved[v * 3 + 1], moved[v * 3 + 2]};
    if (rigid[v] != SEMBLANTE_RIGID_NONE) {
      const float at_rest[3] = {rest[v], rest[v + SEMBLANTE_GROUP], rest[v + 2 * SEMBLANTE_GROUP]};
      semblante_move_local(&pose->local, rigid[v], lid_weights(row, v, rigid[v]), at_rest, p);
    }
    const uint8_t turn = face->turn[first + v];
    if (turn == SEMBLANTE_TURN_FULL) {
      semblante_move(&pose->head, p);
    } else if (turn != 0) {
      const semblante_rigid_motion part = semblante_part_of_turn(pose->head_rotation, pose->head.pivot, turn);
      semblante_move(&part, p);
    }
    to[v * 3] = p[0];
    to[v * 3 + 1] = p[1];
    to[v * 3 + 2] = p[2];
  }
}

static inline __attribute__((always_inline)) int any_changed(const uint8_t* changed, const uint8_t* points,
                                                             uint32_t count) {
  unsigned any = 0;
  for (uint32_t k = 0; k < count; ++k) {
    any |= changed[points[k]];
  }
  return any != 0;
}

/* Eq. 7 of one group. Starts with the first product instead of zero, which gives the same sum. */
static inline __attribute__((always_inline)) void sum_group(const float (*fp)[4], const uint8_t* points,
                                                            const reg* weights, uint32_t count, const reg* rest,
                                                            reg p[REGISTERS][3]) {
  for (uint32_t r = 0; r < REGISTERS; ++r) {
    for (uint32_t i = 0; i < 3; ++i) {
      p[r][i] = count == 0 ? (reg){0} : weights[r] * fp[points[0]][i];
    }
  }
  for (uint32_t k = 1; k < count; ++k) {
    const float* const by = fp[points[k]];
    for (uint32_t r = 0; r < REGISTERS; ++r) {
      const reg w = weights[k * REGISTERS + r];
      p[r][0] += w * by[0];
      p[r][1] += w * by[1];
      p[r][2] += w * by[2];
    }
  }
  for (uint32_t r = 0; r < REGISTERS; ++r) {
    for (uint32_t i = 0; i < 3; ++i) {
      p[r][i] = rest[i * REGISTERS + r] + p[r][i];
    }
  }
}

/* The motions of a run's vertices after Eq. 7. */
typedef enum after { AFTER_NOTHING, AFTER_HEAD, AFTER_PART_AND_HEAD, AFTER_BY_VERTEX } after;

static inline __attribute__((always_inline)) void deform_run(const semblante_prepared_face* face,
                                                             const semblante_group_pose* pose, float* positions,
                                                             const semblante_run* run, uint32_t count, after then,
                                                             const semblante_rigid_motion* part, cursor* at) {
  /* Copies, so that the compiler knows that writing positions does not change them. */
  const semblante_rigid_motion head = pose->head;
  const semblante_rigid_motion own = part != NULL ? *part : head;
  const uint32_t groups = run->group_count;
  const int part_changed = run->part != SEMBLANTE_GROUP_BODY &&
                           (pose->head_changed || (run->part != SEMBLANTE_GROUP_NONE && pose->local_changed));
  const uint8_t* const changed = part_changed ? NULL : pose->changed_points;
  const reg* weights = at->weights;
  const reg* rest = at->rest;
  const uint8_t* points = at->points;
  const uint32_t* const first = at->first;
  uint32_t written = 0;
  for (uint32_t g = 0; g < groups; ++g) {
    if (changed == NULL || any_changed(changed, points, count)) {
      reg p[REGISTERS][3];
      sum_group(pose->fp, points, weights, count, rest, p);
      float* const to = positions + (size_t)first[g] * 3;
      if (then == AFTER_BY_VERTEX) {
        float moved[SEMBLANTE_GROUP * 3];
        for (uint32_t r = 0; r < REGISTERS; ++r) {
          store_rows(p[r][0], p[r][1], p[r][2], moved + (size_t)r * SEMBLANTE_LANES * 3);
        }
        const group_row row = {points, (const float*)weights, count};
        finish_by_vertex(face, pose, &row, (const float*)rest, first[g], moved, to);
      } else {
        for (uint32_t r = 0; r < REGISTERS; ++r) {
          if (then == AFTER_PART_AND_HEAD) {
            move_registers(&own, 1, p[r]);
          }
          if (then != AFTER_NOTHING) {
            move_registers(&head, 0, p[r]);
          }
          store_rows(p[r][0], p[r][1], p[r][2], to + (size_t)r * SEMBLANTE_LANES * 3);
        }
      }
      ++written;
    }
    weights += count * REGISTERS;
    rest += 3 * REGISTERS;
    points += count;
  }
  at->weights = weights;
  at->rest = rest;
  at->points = points;
  at->first = first + groups;
  at->written += written * SEMBLANTE_GROUP;
}

/* Separate loops for the most frequent numbers of points; not in the WebAssembly module, to keep it small. */
static inline __attribute__((always_inline)) void deform_run_of(const semblante_prepared_face* face,
                                                                const semblante_group_pose* pose, float* positions,
                                                                const semblante_run* run, after then, cursor* at) {
  switch (run->point_count) {
#if !defined(__wasm__)
    case 0:
      deform_run(face, pose, positions, run, 0, then, NULL, at);
      break;
    case 1:
      deform_run(face, pose, positions, run, 1, then, NULL, at);
      break;
    case 2:
      deform_run(face, pose, positions, run, 2, then, NULL, at);
      break;
    case 3:
      deform_run(face, pose, positions, run, 3, then, NULL, at);
      break;
    case 4:
      deform_run(face, pose, positions, run, 4, then, NULL, at);
      break;
#endif
    default:
      deform_run(face, pose, positions, run, run->point_count, then, NULL, at);
      break;
  }
}

/* The motions of a part in this pose. *eye: the eye that rotates it. */
static after after_of(uint32_t part, const semblante_group_pose* pose, uint32_t* eye) {
  *eye = 0;
  if (part == SEMBLANTE_GROUP_BODY) {
    return AFTER_NOTHING;
  }
  *eye = part == SEMBLANTE_GROUP_RIGHT_EYE || part == SEMBLANTE_GROUP_RIGHT_IRIS;
  const int iris = part == SEMBLANTE_GROUP_LEFT_IRIS || part == SEMBLANTE_GROUP_RIGHT_IRIS;
  if (part == SEMBLANTE_GROUP_MIXED || (part == SEMBLANTE_GROUP_TONGUE && pose->tongue_moves) ||
      (iris && pose->iris_moves[*eye])) {
    return AFTER_BY_VERTEX;
  }
  if (part != SEMBLANTE_GROUP_NONE && part != SEMBLANTE_GROUP_TONGUE && pose->eye_moves[*eye]) {
    return AFTER_PART_AND_HEAD;
  }
  return pose->head_moves ? AFTER_HEAD : AFTER_NOTHING;
}

uint32_t SEMBLANTE_DEFORM_GROUPS(const semblante_prepared_face* face, const semblante_group_pose* pose,
                                 float* positions) {
  cursor at = {(const reg*)face->rest, (const reg*)face->weights, face->points, face->first, 0};
  for (uint32_t r = 0; r < face->run_count; ++r) {
    const semblante_run* const run = &face->runs[r];
    uint32_t eye = 0;
    switch (after_of(run->part, pose, &eye)) {
      case AFTER_NOTHING:
        deform_run_of(face, pose, positions, run, AFTER_NOTHING, &at);
        break;
      case AFTER_HEAD:
        deform_run_of(face, pose, positions, run, AFTER_HEAD, &at);
        break;
      case AFTER_PART_AND_HEAD:
        deform_run(face, pose, positions, run, run->point_count, AFTER_PART_AND_HEAD, &pose->local.eye[eye], &at);
        break;
      case AFTER_BY_VERTEX:
        deform_run(face, pose, positions, run, run->point_count, AFTER_BY_VERTEX, NULL, &at);
        break;
    }
  }
  return at.written;
}

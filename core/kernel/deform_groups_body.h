/* Internal: Eq. 7, local motions and the head's motion for groups of vertices. The including file defines
 * SEMBLANTE_LANES, the number of floats per register (4, 8 or 16), SEMBLANTE_GROUP, the vertices of a group, and
 * SEMBLANTE_DEFORM_GROUPS, the name of the function.
 * Every lane adds the same terms as semblante_deform in the same order, so that all variants are bit-identical to it.
 */
#include "core/kernel/lane_motions.h"
#include "core/kernel/prepared_layout.h"
#include "core/tables/generated/mpeg4_tables.h"

#define REGISTERS (SEMBLANTE_GROUP / SEMBLANTE_LANES) /* registers per coordinate of a group */

/* For the caller's floats: only 4-byte alignment, and may alias other types. */
typedef float loose_quad __attribute__((vector_size(16), aligned(4), may_alias));
typedef float quad __attribute__((vector_size(16)));

/* Stores x, y, z of the vertices of a register as x y z x y z ... Four and eight: shuffles stay within 128 bits as far
 * as possible. Sixteen: a permutation that merges x and y, and one that puts z between. */
static inline __attribute__((always_inline)) void store_rows(reg x, reg y, reg z, float* to) {
#if SEMBLANTE_LANES == 16
  /* 0..15: of the first operand, 16..31: of the second; z's places in `xy` are free. */
  static const int32_t xy[3][16] = {{0, 16, 0, 1, 17, 0, 2, 18, 0, 3, 19, 0, 4, 20, 0, 5},
                                    {21, 0, 6, 22, 0, 7, 23, 0, 8, 24, 0, 9, 25, 0, 10, 26},
                                    {0, 11, 27, 0, 12, 28, 0, 13, 29, 0, 14, 30, 0, 15, 31, 0}};
  static const int32_t xy_z[3][16] = {{0, 1, 16, 3, 4, 17, 6, 7, 18, 9, 10, 19, 12, 13, 20, 15},
                                      {0, 21, 2, 3, 22, 5, 6, 23, 8, 9, 24, 11, 12, 25, 14, 15},
                                      {26, 1, 2, 27, 4, 5, 28, 7, 8, 29, 10, 11, 30, 13, 14, 31}};
  for (int i = 0; i < 3; ++i) {
    const __m512 both = _mm512_permutex2var_ps((__m512)x, _mm512_loadu_si512(xy[i]), (__m512)y);
    _mm512_storeu_ps(to + i * 16, _mm512_permutex2var_ps(both, _mm512_loadu_si512(xy_z[i]), (__m512)z));
  }
#elif SEMBLANTE_LANES == 8
  const reg xy = __builtin_shufflevector(x, y, 0, 2, 8, 10, 4, 6, 12, 14);
  const reg yz = __builtin_shufflevector(y, z, 1, 3, 9, 11, 5, 7, 13, 15);
  const reg zx = __builtin_shufflevector(z, x, 0, 2, 9, 11, 4, 6, 13, 15);
  const reg a = __builtin_shufflevector(xy, zx, 0, 2, 8, 10, 4, 6, 12, 14);
  const reg b = __builtin_shufflevector(yz, xy, 0, 2, 9, 11, 4, 6, 13, 15);
  const reg c = __builtin_shufflevector(zx, yz, 1, 3, 9, 11, 5, 7, 13, 15);
  _mm256_storeu_ps(to, _mm256_insertf128_ps((__m256)a, _mm256_castps256_ps128((__m256)b), 1));
  _mm256_storeu_ps(to + 8, _mm256_blend_ps((__m256)c, (__m256)a, 0xF0));
  _mm256_storeu_ps(to + 16, _mm256_permute2f128_ps((__m256)b, (__m256)c, 0x31));
#else
  const reg xy = __builtin_shufflevector(x, y, 0, 2, 4, 6);
  const reg yz = __builtin_shufflevector(y, z, 1, 3, 5, 7);
  const reg zx = __builtin_shufflevector(z, x, 0, 2, 5, 7);
  *(loose_quad*)(to + 0) = __builtin_shufflevector(xy, zx, 0, 2, 4, 6);
  *(loose_quad*)(to + 4) = __builtin_shufflevector(yz, xy, 0, 2, 5, 7);
  *(loose_quad*)(to + 8) = __builtin_shufflevector(zx, yz, 1, 3, 5, 7);
#endif
}

/* The current position in the arrays of the prepared face. */
typedef struct cursor {
  const reg* rest;
  const reg* weights;
  const uint8_t* points;
  const uint32_t* first;
  const uint8_t* lids;
  const reg* clearance;
  uint32_t written;
} cursor;

/* The weights of one register's vertices for the point of a lid. `weights`: of the group; `at`: see
 * semblante_prepared_face.lids. */
static inline __attribute__((always_inline)) reg lid_weights(const reg* weights, uint32_t r, uint8_t at) {
  return at == SEMBLANTE_NO_POINT ? (reg){0} : weights[at * REGISTERS + r];
}

/* With eight lanes or more, a copy of these formulas in every loop gains a twentieth of the time; with four it gains
 * nothing, and the WebAssembly module is to stay small. */
#if SEMBLANTE_LANES >= 8
#define EACH_FUNCTION LANE_FUNCTION
#else
#define EACH_FUNCTION static __attribute__((noinline))
#endif

/* A register of vertices of lids, between the motions. */
typedef struct lid_register {
  reg p[3];
  reg way;    /* see clear_ball */
  mask close; /* the lanes that clear_ball is still to move */
  const reg* rest;
  const reg* clearance; /* at rest, or null */
} lid_register;

/* The lids of one eye in one register r of a group, by Eq. 7 at l->p, rolled but not yet clear of the ball. `at`: where
 * their upper and lower point are, see semblante_prepared_face.lids; `clearance`: that of the group at rest, or null.
 */
EACH_FUNCTION void roll_register(const semblante_lid_roll* roll, mask where, const reg* weights, uint32_t r,
                                 const uint8_t* at, const reg* rest, const reg* clearance, lid_register* l) {
  const reg own_rest[3] = {rest[r], rest[REGISTERS + r], rest[2 * REGISTERS + r]};
  l->rest = rest + r;
  l->clearance = clearance != NULL ? clearance + r : NULL;
  l->close =
      roll_lids(roll, where, lid_weights(weights, r, at[0]), lid_weights(weights, r, at[1]), own_rest, l->p, &l->way);
}

EACH_FUNCTION void clear_register(const semblante_lid_roll* roll, lid_register* l) {
  const reg own_rest[3] = {l->rest[0], l->rest[REGISTERS], l->rest[2 * REGISTERS]};
  clear_ball(roll, l->close, l->way, own_rest, l->clearance, l->p);
}

/* The tongue's motion, vertex by vertex: few heads roll it often. */
static __attribute__((noinline)) void roll_tongue(const semblante_pose* pose, const uint8_t* rigid, const reg rest[3],
                                                  reg p[3]) {
  for (int lane = 0; lane < SEMBLANTE_LANES; ++lane) {
    if (rigid[lane] >= SEMBLANTE_RIGID_TONGUE) {
      const float from[3] = {rest[0][lane], rest[1][lane], rest[2][lane]};
      float to[3] = {p[0][lane], p[1][lane], p[2][lane]};
      semblante_roll_tongue(pose, rigid[lane], from, to);
      for (int i = 0; i < 3; ++i) {
        p[i][lane] = to[i];
      }
    }
  }
}

/* The head's motion where vertices of one register have different shares of it. */
EACH_FUNCTION void turn_each(const semblante_rigid_motion* head, const float rotation[4], ints turn, reg p[3]) {
  const mask fully = equals(turn, SEMBLANTE_TURN_FULL);
  const mask partly = ~(fully | equals(turn, 0));
  const reg before[3] = {p[0], p[1], p[2]};
  if (any(fully)) {
    reg q[3] = {before[0], before[1], before[2]};
    move_rigidly(head, 0, q);
    choose_point(fully, q, p);
  }
  if (any(partly)) {
    reg q[3] = {before[0], before[1], before[2]};
    turn_partly(rotation, head->pivot, turn, q);
    choose_point(partly, q, p);
  }
}

/* Local motions and the head's where vertices of one register differ in them. */
static __attribute__((noinline)) void move_each(const semblante_prepared_face* face, const semblante_group_pose* pose,
                                                const reg* weights, const uint8_t* lid_points, uint32_t r,
                                                uint32_t first, const reg* rest, const reg* clearance, reg p[3]) {
  const uint8_t* const rigid = face->rigid + first;
  const ints parts = load_bytes(rigid);
  if (any(~equals(parts, SEMBLANTE_RIGID_NONE))) {
    const semblante_pose* const of = pose->local.pose;
    const reg own_rest[3] = {rest[r], rest[REGISTERS + r], rest[2 * REGISTERS + r]};
    for (int eye = 0; eye < 2; ++eye) {
      const mask lids = equals(parts, SEMBLANTE_RIGID_LEFT_LIDS + eye);
      if (any(lids)) {
        lid_register l = {.p = {p[0], p[1], p[2]}};
        roll_register(&pose->local.lids[eye], lids, weights, r, lid_points + 2 * eye, rest,
                      pose->knows_clearance[eye] ? clearance : NULL, &l);
        if (any(l.close)) {
          clear_register(&pose->local.lids[eye], &l);
        }
        p[0] = l.p[0], p[1] = l.p[1], p[2] = l.p[2];
      }
      const mask iris = equals(parts, SEMBLANTE_RIGID_LEFT_IRIS + eye);
      const mask ball = iris | equals(parts, SEMBLANTE_RIGID_LEFT_EYE + eye);
      if ((pose->iris_moves[eye] || pose->eye_moves[eye]) && any(ball)) {
        reg q[3] = {p[0], p[1], p[2]};
        move_iris(&of->iris[eye], of->eye_pivot[eye], of->pupil_growth[eye], own_rest, q);
        choose_point(iris, q, p);
        q[0] = p[0], q[1] = p[1], q[2] = p[2];
        move_rigidly(&pose->local.eye[eye], 1, q);
        choose_point(ball, q, p);
      }
    }
    if (pose->tongue_moves) {
      roll_tongue(of, rigid, own_rest, p);
    }
  }
  if (pose->head_moves) {
    turn_each(&pose->head, pose->head_rotation, load_bytes(face->turn + first), p);
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
  if (count == 0) {
    for (uint32_t r = 0; r < REGISTERS; ++r) {
      for (uint32_t i = 0; i < 3; ++i) {
        p[r][i] = rest[i * REGISTERS + r];
      }
    }
    return;
  }
  reg sum[REGISTERS][3]; /* not `p`, whose address others have: it would be written for each point */
  for (uint32_t r = 0; r < REGISTERS; ++r) {
    for (uint32_t i = 0; i < 3; ++i) {
      sum[r][i] = weights[r] * fp[points[0]][i];
    }
  }
  for (uint32_t k = 1; k < count; ++k) {
    const float* const by = fp[points[k]];
    for (uint32_t r = 0; r < REGISTERS; ++r) {
      const reg w = weights[k * REGISTERS + r];
      sum[r][0] += w * by[0];
      sum[r][1] += w * by[1];
      sum[r][2] += w * by[2];
    }
  }
  for (uint32_t r = 0; r < REGISTERS; ++r) {
    for (uint32_t i = 0; i < 3; ++i) {
      p[r][i] = rest[i * REGISTERS + r] + sum[r][i];
    }
  }
}

/* The motions of a run's vertices after Eq. 7. */
typedef enum after { AFTER_NOTHING, AFTER_HEAD, AFTER_PART_AND_HEAD, AFTER_LIDS, AFTER_NECK, AFTER_EACH } after;

/* A run of lids in batches: one motion of all groups of a batch, then the next. A motion is a long chain of dependent
 * operations; the processor overlaps the chains of different registers, and more of them if a chain is short. The
 * registers near the ball are listed first, since a branch for each of them would often be mispredicted. */
#define LID_BATCH (16U / REGISTERS)

static inline __attribute__((always_inline)) void deform_lids(const semblante_prepared_face* face,
                                                              const semblante_group_pose* pose, float* positions,
                                                              const semblante_run* run, cursor* at) {
  const semblante_rigid_motion head = pose->head;
  const uint32_t count = run->point_count;
  const uint32_t eye = run->part == SEMBLANTE_GROUP_RIGHT_LIDS;
  const semblante_lid_roll* const roll = &pose->local.lids[eye];
  const uint8_t* const changed = pose->head_changed || pose->local_changed ? NULL : pose->changed_points;
  for (uint32_t left = run->group_count; left > 0;) {
    lid_register batch[LID_BATCH * REGISTERS];
    lid_register* close[LID_BATCH * REGISTERS];
    uint32_t first[LID_BATCH];
    uint32_t groups = 0;
    uint32_t close_count = 0;
    for (; groups < LID_BATCH && left > 0; --left) {
      if (changed == NULL || any_changed(changed, at->points, count)) {
        reg p[REGISTERS][3];
        sum_group(pose->fp, at->points, at->weights, count, at->rest, p);
        for (uint32_t r = 0; r < REGISTERS; ++r) {
          lid_register* const l = &batch[groups * REGISTERS + r];
          l->p[0] = p[r][0], l->p[1] = p[r][1], l->p[2] = p[r][2];
          const mask where = equals(load_bytes(face->rigid + *at->first + r * SEMBLANTE_LANES),
                                    (int32_t)(SEMBLANTE_RIGID_LEFT_LIDS + eye));
          roll_register(roll, where, at->weights, r, at->lids + eye * 2U, at->rest,
                        pose->knows_clearance[eye] ? at->clearance : NULL, l);
          close[close_count] = l;
          close_count += any(l->close) ? 1U : 0U;
        }
        first[groups++] = *at->first;
      }
      at->weights += count * REGISTERS;
      at->rest += 3 * REGISTERS;
      at->points += count;
      at->first += 1;
      at->lids += 4;
      at->clearance += REGISTERS;
    }
    for (uint32_t c = 0; c < close_count; ++c) {
      clear_register(roll, close[c]);
    }
    for (uint32_t r = 0; r < groups * REGISTERS; ++r) {
      reg* const p = batch[r].p;
      if (pose->head_moves) {
        move_rigidly(&head, 0, p);
      }
      store_rows(p[0], p[1], p[2], positions + ((size_t)first[r / REGISTERS] + (r % REGISTERS) * SEMBLANTE_LANES) * 3);
    }
    at->written += groups * SEMBLANTE_GROUP;
  }
}

static inline __attribute__((always_inline)) void deform_run(const semblante_prepared_face* face,
                                                             const semblante_group_pose* pose, float* positions,
                                                             const semblante_run* run, uint32_t count, after then,
                                                             const semblante_rigid_motion* part, cursor* at) {
  /* Copies, so that the compiler knows that writing positions does not change them. */
  const semblante_rigid_motion head = pose->head;
  const semblante_rigid_motion own = part != NULL ? *part : head;
  const uint32_t groups = run->group_count;
  const int is_skin =
      run->part == SEMBLANTE_GROUP_NONE || run->part == SEMBLANTE_GROUP_BODY || run->part == SEMBLANTE_GROUP_NECK;
  const int part_changed =
      (run->part != SEMBLANTE_GROUP_BODY && pose->head_changed) || (!is_skin && pose->local_changed);
  const uint8_t* const changed = part_changed ? NULL : pose->changed_points;
  const reg* weights = at->weights;
  const reg* rest = at->rest;
  const uint8_t* points = at->points;
  const uint32_t* const first = at->first;
  const uint8_t* const lids = at->lids;
  const reg* const clearance = at->clearance;
  const int has_lids = semblante_has_lids(run->part);
  uint32_t written = 0;
  for (uint32_t g = 0; g < groups; ++g) {
    if (changed == NULL || any_changed(changed, points, count)) {
      reg p[REGISTERS][3];
      sum_group(pose->fp, points, weights, count, rest, p);
      float* const to = positions + (size_t)first[g] * 3;
      if (then == AFTER_EACH) {
        const uint32_t left = face->vertex_count - first[g];
        float partial[SEMBLANTE_GROUP * 3];
        float* const whole_group = left < SEMBLANTE_GROUP ? partial : to;
        for (uint32_t r = 0; r < REGISTERS; ++r) {
          move_each(face, pose, weights, lids + g * 4U, r, first[g] + r * SEMBLANTE_LANES, rest,
                    has_lids ? clearance + g * REGISTERS : NULL, p[r]);
          store_rows(p[r][0], p[r][1], p[r][2], whole_group + (size_t)r * SEMBLANTE_LANES * 3);
        }
        for (uint32_t i = 0; left < SEMBLANTE_GROUP && i < left * 3; ++i) {
          to[i] = partial[i];
        }
      } else {
        for (uint32_t r = 0; r < REGISTERS; ++r) {
          if (then == AFTER_NECK) {
            turn_each(&head, pose->head_rotation, load_bytes(face->turn + first[g] + r * SEMBLANTE_LANES), p[r]);
          }
          if (then == AFTER_PART_AND_HEAD) {
            move_rigidly(&own, 1, p[r]);
          }
          if (then == AFTER_HEAD || then == AFTER_PART_AND_HEAD) {
            move_rigidly(&head, 0, p[r]);
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
  at->lids = lids + groups * 4U;
  at->clearance = clearance + (has_lids ? groups * REGISTERS : 0U);
  at->written += written * SEMBLANTE_GROUP;
}

/* Separate loops for the most frequent numbers of points, where they gain more than a hundredth of the time (with SSE2
 * they do not) and size is no matter (in the WebAssembly module it is). */
static inline __attribute__((always_inline)) void deform_run_of(const semblante_prepared_face* face,
                                                                const semblante_group_pose* pose, float* positions,
                                                                const semblante_run* run, after then, cursor* at) {
  switch (run->point_count) {
#if SEMBLANTE_LANES >= 8 || defined(__aarch64__)
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
  if (part == SEMBLANTE_GROUP_NECK) {
    return pose->head_moves ? AFTER_NECK : AFTER_NOTHING;
  }
  if (part == SEMBLANTE_GROUP_LEFT_LIDS || part == SEMBLANTE_GROUP_RIGHT_LIDS) {
    return AFTER_LIDS;
  }
  *eye = part == SEMBLANTE_GROUP_RIGHT_EYE || part == SEMBLANTE_GROUP_RIGHT_IRIS;
  const int iris = part == SEMBLANTE_GROUP_LEFT_IRIS || part == SEMBLANTE_GROUP_RIGHT_IRIS;
  if (part == SEMBLANTE_GROUP_MIXED || (part == SEMBLANTE_GROUP_TONGUE && pose->tongue_moves) ||
      (iris && pose->iris_moves[*eye])) {
    return AFTER_EACH;
  }
  if (part != SEMBLANTE_GROUP_NONE && part != SEMBLANTE_GROUP_TONGUE && pose->eye_moves[*eye]) {
    return AFTER_PART_AND_HEAD;
  }
  return pose->head_moves ? AFTER_HEAD : AFTER_NOTHING;
}

uint32_t SEMBLANTE_DEFORM_GROUPS(const semblante_prepared_face* face, const semblante_group_pose* pose,
                                 float* positions) {
  cursor at = {(const reg*)face->rest,
               (const reg*)face->weights,
               face->points,
               face->first,
               face->lids,
               (const reg*)face->clearance,
               0};
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
      case AFTER_LIDS:
        deform_lids(face, pose, positions, run, &at);
        break;
      case AFTER_NECK:
        deform_run(face, pose, positions, run, run->point_count, AFTER_NECK, NULL, &at);
        break;
      case AFTER_EACH:
        deform_run(face, pose, positions, run, run->point_count, AFTER_EACH, NULL, &at);
        break;
    }
  }
  return at.written;
}

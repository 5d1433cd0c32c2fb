/* Regroups the influence table: see semblante_prepared_face.h. */
#include "core/kernel/export.h"
#include "core/kernel/lids.h"
#include "core/kernel/prepared_layout.h"
#include "core/tables/generated/mpeg4_tables.h"

/* Groups are sorted within windows of this size, so that writes stay local. */
#define WINDOW 4096U
#define KEYS (SEMBLANTE_GROUP_PARTS * (SEMBLANTE_FP_COUNT + 1))

/* The properties of one group, before it is written. */
typedef struct group_facts {
  uint32_t point_count;
  uint32_t part;
  uint8_t points[SEMBLANTE_FP_COUNT];
  int rises; /* whether the points of each row are increasing */
} group_facts;

static uint8_t rigid_of(const semblante_face* face, uint32_t v) {
  return face->rigid == NULL ? SEMBLANTE_RIGID_NONE : face->rigid[v];
}

static uint8_t turn_of(const semblante_face* face, uint32_t v) {
  return face->turn == NULL ? SEMBLANTE_TURN_FULL : face->turn[v];
}

/* The part of a group of one vertex. */
static uint32_t part_of(uint8_t rigid, uint8_t turn) {
  if (turn != SEMBLANTE_TURN_FULL) {
    return rigid != SEMBLANTE_RIGID_NONE ? SEMBLANTE_GROUP_MIXED
           : turn == 0                   ? SEMBLANTE_GROUP_BODY
                                         : SEMBLANTE_GROUP_NECK;
  }
  return rigid >= SEMBLANTE_RIGID_TONGUE       ? SEMBLANTE_GROUP_TONGUE
         : rigid == SEMBLANTE_RIGID_LEFT_LIDS  ? SEMBLANTE_GROUP_LEFT_LIDS
         : rigid == SEMBLANTE_RIGID_RIGHT_LIDS ? SEMBLANTE_GROUP_RIGHT_LIDS
         : rigid == SEMBLANTE_RIGID_LEFT_EYE   ? SEMBLANTE_GROUP_LEFT_EYE
         : rigid == SEMBLANTE_RIGID_RIGHT_EYE  ? SEMBLANTE_GROUP_RIGHT_EYE
         : rigid == SEMBLANTE_RIGID_LEFT_IRIS  ? SEMBLANTE_GROUP_LEFT_IRIS
         : rigid == SEMBLANTE_RIGID_RIGHT_IRIS ? SEMBLANTE_GROUP_RIGHT_IRIS
                                               : SEMBLANTE_GROUP_NONE;
}

/* The part of a group after adding one vertex. */
static uint32_t join_part(uint32_t part, int is_first, uint32_t own) {
  if (is_first || own == part) {
    return own;
  }
  const uint32_t both = 1U << own | 1U << part;
  if (both == (1U << SEMBLANTE_GROUP_LEFT_EYE | 1U << SEMBLANTE_GROUP_LEFT_IRIS)) {
    return SEMBLANTE_GROUP_LEFT_IRIS;
  }
  if (both == (1U << SEMBLANTE_GROUP_RIGHT_EYE | 1U << SEMBLANTE_GROUP_RIGHT_IRIS)) {
    return SEMBLANTE_GROUP_RIGHT_IRIS;
  }
  const uint32_t beside_none = both & ~(1U << SEMBLANTE_GROUP_NONE);
  if (beside_none == 1U << SEMBLANTE_GROUP_TONGUE || beside_none == 1U << SEMBLANTE_GROUP_LEFT_LIDS ||
      beside_none == 1U << SEMBLANTE_GROUP_RIGHT_LIDS) {
    return part == SEMBLANTE_GROUP_NONE ? own : part;
  }
  const uint32_t skin = 1U << SEMBLANTE_GROUP_NONE | 1U << SEMBLANTE_GROUP_BODY | 1U << SEMBLANTE_GROUP_NECK;
  return (both & ~skin) == 0 ? SEMBLANTE_GROUP_NECK : SEMBLANTE_GROUP_MIXED;
}

static __attribute__((noinline)) group_facts facts_of(const semblante_face* face, uint32_t size, uint32_t group) {
  group_facts facts;
  facts.point_count = 0;
  facts.part = SEMBLANTE_GROUP_NONE;
  facts.rises = 1;
  uint8_t used[SEMBLANTE_FP_COUNT];
  for (uint32_t fp = 0; fp < SEMBLANTE_FP_COUNT; ++fp) {
    used[fp] = 0;
  }
  const uint32_t first = group * size;
  const uint32_t left = face->vertex_count - first;
  const uint32_t end = first + (left < size ? left : size);
  for (uint32_t v = first; v < end; ++v) {
    facts.part = join_part(facts.part, v == first, part_of(rigid_of(face, v), turn_of(face, v)));
    for (uint32_t k = face->row_offsets[v]; k < face->row_offsets[v + 1]; ++k) {
      if (k > face->row_offsets[v] && face->row_points[k] <= face->row_points[k - 1]) {
        facts.rises = 0;
      }
      used[face->row_points[k]] = 1;
    }
  }
  if (left < size) {
    facts.part = SEMBLANTE_GROUP_MIXED;
  }
  for (uint32_t fp = 0; fp < SEMBLANTE_FP_COUNT; ++fp) {
    if (used[fp]) {
      facts.points[facts.point_count++] = (uint8_t)fp;
    }
  }
  return facts;
}

static uint32_t key_of(const group_facts* facts) { return facts->part * (SEMBLANTE_FP_COUNT + 1) + facts->point_count; }

static uint32_t group_count_of(const semblante_face* face, uint32_t size) {
  return face->vertex_count / size + (face->vertex_count % size != 0);
}

static uint32_t window_end(uint32_t first, uint32_t groups) {
  return groups - first < WINDOW ? groups : first + WINDOW;
}

/* Counts the groups of a window by key; false if the points of a row are not increasing. */
static int count_keys(const semblante_face* face, uint32_t size, uint32_t first, uint32_t end, uint16_t by_key[KEYS]) {
  for (uint32_t key = 0; key < KEYS; ++key) {
    by_key[key] = 0;
  }
  for (uint32_t group = first; group < end; ++group) {
    const group_facts facts = facts_of(face, size, group);
    if (!facts.rises) {
      return 0;
    }
    ++by_key[key_of(&facts)];
  }
  return 1;
}

/* The offsets of the arrays of a prepared face from its header, and its total size. */
typedef struct layout {
  size_t runs, first, rest, weights, points, lids, rigid, turn, clearance, end;
  uint32_t run_count;
} layout;

static size_t place(size_t* end, size_t bytes) {
  const size_t at = *end;
  *end = (at + bytes + 63) / 64 * 64;
  return at;
}

/* `end` is 0 if the points of a row are not increasing. */
static layout lay_out(const semblante_face* face, uint32_t size) {
  layout l = {0};
  const uint32_t groups = group_count_of(face, size);
  size_t united = 0;
  size_t with_lids = 0;
  for (uint32_t first = 0; first < groups; first = window_end(first, groups)) {
    uint16_t by_key[KEYS];
    if (!count_keys(face, size, first, window_end(first, groups), by_key)) {
      return l;
    }
    for (uint32_t key = 0; key < KEYS; ++key) {
      l.run_count += by_key[key] != 0;
      united += (size_t)by_key[key] * (key % (SEMBLANTE_FP_COUNT + 1));
      with_lids += semblante_has_lids(key / (SEMBLANTE_FP_COUNT + 1)) ? by_key[key] : 0U;
    }
  }
  place(&l.end, sizeof(semblante_prepared_face));
  l.runs = place(&l.end, l.run_count * sizeof(semblante_run));
  l.first = place(&l.end, groups * sizeof(uint32_t));
  l.rest = place(&l.end, (size_t)groups * size * 3 * sizeof(float));
  l.weights = place(&l.end, united * size * sizeof(float));
  l.points = place(&l.end, united);
  l.lids = place(&l.end, (size_t)groups * 4);
  l.rigid = place(&l.end, (size_t)groups * size);
  l.turn = place(&l.end, (size_t)groups * size);
  l.clearance = place(&l.end, with_lids * size * sizeof(float));
  return l;
}

/* The size of groups for the machine's widest registers. */
static uint32_t best_size(void) {
  uint32_t count = 0;
  const semblante_deform_variant* const variants = semblante_deform_variants(&count);
  return variants[count - 1].group_size;
}

size_t semblante_prepared_size_by(uint32_t group_size, const semblante_face* face) {
  return lay_out(face, group_size).end;
}

SEMBLANTE_EXPORT(semblante_prepared_size)
size_t semblante_prepared_size(const semblante_face* face) { return semblante_prepared_size_by(best_size(), face); }

/* Minus zero becomes zero, as it does when Eq. 7 adds a displacement of zero: groups without points need no sum. */
static void write_rest(const semblante_face* face, uint32_t size, uint32_t group, float* rest) {
  for (uint32_t lane = 0; lane < size; ++lane) {
    const uint32_t v = group * size + lane;
    for (uint32_t i = 0; i < 3; ++i) {
      rest[i * size + lane] = v < face->vertex_count ? face->rest[(size_t)v * 3 + i] + 0.0F : 0.0F;
    }
  }
}

static void write_weights(const semblante_face* face, uint32_t size, uint32_t group, const group_facts* facts,
                          float* weights) {
  for (uint32_t i = 0; i < facts->point_count * size; ++i) {
    weights[i] = 0.0F;
  }
  for (uint32_t lane = 0; lane < size; ++lane) {
    const uint32_t v = group * size + lane;
    if (v >= face->vertex_count) {
      return;
    }
    uint32_t at = 0;
    for (uint32_t k = face->row_offsets[v]; k < face->row_offsets[v + 1]; ++k) {
      while (facts->points[at] != face->row_points[k]) {
        ++at;
      }
      weights[at * size + lane] = face->row_weights[k];
    }
  }
}

static void write_lids(const group_facts* facts, uint8_t lids[4]) {
  const uint32_t wanted[4] = {SEMBLANTE_UPPER_LID(0), SEMBLANTE_LOWER_LID(0), SEMBLANTE_UPPER_LID(1),
                              SEMBLANTE_LOWER_LID(1)};
  for (uint32_t i = 0; i < 4; ++i) {
    lids[i] = SEMBLANTE_NO_POINT;
    for (uint32_t k = 0; k < facts->point_count; ++k) {
      if (facts->points[k] == wanted[i]) {
        lids[i] = (uint8_t)k;
      }
    }
  }
}

static void write_clearance(const semblante_face* face, const semblante_rig* rig, uint32_t size, uint32_t group,
                            float* clearance) {
  for (uint32_t lane = 0; lane < size; ++lane) {
    const uint32_t v = group * size + lane;
    const int eye = v < face->vertex_count ? semblante_lids_of(rigid_of(face, v)) : -1;
    clearance[lane] = eye < 0 || rig == NULL ? 0.0F
                                             : semblante_clearance_at_rest(&rig->lids[eye], rig->eye_pivot[eye],
                                                                           &face->rest[(size_t)v * 3]);
  }
}

const semblante_prepared_face* semblante_prepare_by(uint32_t group_size, const semblante_face* face,
                                                    const semblante_rig* rig, void* memory) {
  const uint32_t size = group_size;
  char* const base = memory;
  const uint32_t groups = group_count_of(face, size);
  const layout l = lay_out(face, size);
  semblante_run* run = (semblante_run*)(base + l.runs);
  uint32_t* const first_vertex = (uint32_t*)(base + l.first);
  float* rest = (float*)(base + l.rest);
  float* weights = (float*)(base + l.weights);
  uint8_t* points = (uint8_t*)(base + l.points);
  uint8_t* lids = (uint8_t*)(base + l.lids);
  uint8_t* const rigid = (uint8_t*)(base + l.rigid);
  uint8_t* const turn = (uint8_t*)(base + l.turn);
  float* clearance = (float*)(base + l.clearance);
  semblante_prepared_face* const prepared = memory;
  *prepared = (semblante_prepared_face){.vertex_count = face->vertex_count,
                                        .group_size = size,
                                        .group_count = groups,
                                        .run_count = l.run_count,
                                        .runs = run,
                                        .first = first_vertex,
                                        .rest = rest,
                                        .weights = weights,
                                        .points = points,
                                        .lids = lids,
                                        .rigid = rigid,
                                        .turn = turn,
                                        .clearance = clearance};
  for (int eye = 0; rig != NULL && eye < 2; ++eye) {
    prepared->lids_of_rig[eye] = rig->lids[eye];
    for (int i = 0; i < 3; ++i) {
      prepared->eye_pivot[eye][i] = rig->eye_pivot[eye][i];
    }
  }

  for (uint32_t first = 0; first < groups; first = window_end(first, groups)) {
    const uint32_t end = window_end(first, groups);
    uint16_t slot[KEYS]; /* by key: index of its next group within the window */
    count_keys(face, size, first, end, slot);
    uint16_t taken = 0;
    for (uint32_t key = 0; key < KEYS; ++key) {
      const uint16_t here = slot[key];
      slot[key] = taken;
      taken = (uint16_t)(taken + here);
      if (here != 0) {
        const semblante_run next = {here, (uint16_t)(key % (SEMBLANTE_FP_COUNT + 1)),
                                    (uint16_t)(key / (SEMBLANTE_FP_COUNT + 1))};
        *run++ = next;
      }
    }
    for (uint32_t group = first; group < end; ++group) {
      const group_facts facts = facts_of(face, size, group);
      first_vertex[first + slot[key_of(&facts)]++] = group * size;
    }
    for (uint32_t at = first; at < end; ++at) {
      const uint32_t group = first_vertex[at] / size;
      const group_facts facts = facts_of(face, size, group);
      write_rest(face, size, group, rest);
      write_weights(face, size, group, &facts, weights);
      write_lids(&facts, lids);
      if (semblante_has_lids(facts.part)) {
        write_clearance(face, rig, size, group, clearance);
        clearance += size;
      }
      for (uint32_t k = 0; k < facts.point_count; ++k) {
        points[k] = facts.points[k];
      }
      lids += 4;
      rest += (size_t)size * 3;
      weights += (size_t)facts.point_count * size;
      points += facts.point_count;
    }
  }
  for (uint32_t v = 0; v < groups * size; ++v) {
    rigid[v] = v < face->vertex_count ? rigid_of(face, v) : SEMBLANTE_RIGID_NONE;
    turn[v] = v < face->vertex_count ? turn_of(face, v) : SEMBLANTE_TURN_FULL;
  }
  return prepared;
}

SEMBLANTE_EXPORT(semblante_prepare)
const semblante_prepared_face* semblante_prepare(const semblante_face* face, void* memory) {
  return semblante_prepare_for(face, NULL, memory);
}

SEMBLANTE_EXPORT(semblante_prepare_for)
const semblante_prepared_face* semblante_prepare_for(const semblante_face* face, const semblante_rig* rig,
                                                     void* memory) {
  return semblante_prepare_by(best_size(), face, rig, memory);
}

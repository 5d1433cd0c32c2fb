/* Internal: the data that semblante_prepare writes and the loops over groups read. */
#ifndef SEMBLANTE_KERNEL_PREPARED_LAYOUT_H
#define SEMBLANTE_KERNEL_PREPARED_LAYOUT_H

#include "core/kernel/local_motion.h"
#include "core/kernel/rigid_motion.h"
#include "core/kernel/semblante_prepared_face.h"

/* The motion of a group's vertices after Eq. 7 and before the head's motion. */
typedef enum semblante_group_part {
  SEMBLANTE_GROUP_NONE,
  SEMBLANTE_GROUP_LEFT_EYE,
  SEMBLANTE_GROUP_RIGHT_EYE,
  SEMBLANTE_GROUP_LEFT_IRIS, /* all vertices belong to the eye, some to its iris */
  SEMBLANTE_GROUP_RIGHT_IRIS,
  SEMBLANTE_GROUP_BODY,      /* no vertex has a local motion or turns with the head */
  SEMBLANTE_GROUP_NECK,      /* no vertex has a local motion, and not all turn fully with the head */
  SEMBLANTE_GROUP_TONGUE,    /* some vertices belong to the tongue, the others have no local motion */
  SEMBLANTE_GROUP_LEFT_LIDS, /* some vertices belong to the lids of one eye, the others have no local motion */
  SEMBLANTE_GROUP_RIGHT_LIDS,
  SEMBLANTE_GROUP_MIXED, /* any other combination, and an incomplete last group */
  SEMBLANTE_GROUP_PARTS
} semblante_group_part;

/* The point of a lid (0 left upper, 1 left lower, 2 right upper, 3 right lower) has no weight in a group. */
#define SEMBLANTE_NO_POINT 255U

/* Consecutive groups with the same number of points and the same part: a loop with predictable branches. */
typedef struct semblante_run {
  uint32_t group_count;
  uint16_t point_count; /* of each group */
  uint16_t part;        /* semblante_group_part of each */
} semblante_run;

/* Groups are stored run after run. Every array starts at a multiple of 64 bytes. */
struct semblante_prepared_face {
  uint32_t vertex_count;
  uint32_t group_size;  /* #L, the vertices of a group: 16 if the machine has registers of so many floats, else 8 */
  uint32_t group_count; /* #G; the last group is padded with vertices that are never written */
  uint32_t run_count;   /* #R */
  const semblante_run* runs;
  const uint32_t* first; /* #G: number of the group's first vertex */
  const float* rest;     /* #G by 3 by #L: all x of a group, all y, all z */
  const float* weights;  /* #U by #L: for each point of each group the weights of the group's vertices */
  const uint8_t* points; /* #U, increasing within a group */
  const uint8_t* lids;   /* #G by 4: where the points of the lids are among the group's points; NO_POINT: nowhere */
  const uint8_t* rigid;  /* #V padded to whole groups, by vertex: SEMBLANTE_RIGID_* */
  const uint8_t* turn;   /* likewise: 255ths of the head's rotation */
  /* The eyes that `clearance` was computed for, from the rig; all zero without one. */
  semblante_lids lids_of_rig[2];
  float eye_pivot[2][3];
  /* By #L, for each group of a part with lids (semblante_has_lids): semblante_clearance_at_rest of the vertices of
   * lids. */
  const float* clearance;
};

/* Whether vertices of lids may be in a group. */
static inline int semblante_has_lids(uint32_t part) {
  return part == SEMBLANTE_GROUP_LEFT_LIDS || part == SEMBLANTE_GROUP_RIGHT_LIDS || part == SEMBLANTE_GROUP_MIXED;
}

/* One pose, prepared for all groups. */
typedef struct semblante_group_pose {
  float fp[SEMBLANTE_FP_COUNT][4]; /* the fourth component is unused */
  semblante_rigid_motion head;
  int head_moves;
  const float* head_rotation; /* of the pose; the vertices of the neck have a share of it */
  semblante_local_motions local;
  int eye_moves[2]; /* left, right; a motion that is zero is skipped, which gives the same bits */
  int iris_moves[2];
  int tongue_moves;
  int knows_clearance[2]; /* left, right: the face's clearances are those of this pose's eye */
  /* For semblante_deform_changed; null: everything is computed. */
  const uint8_t* changed_points; /* 84: 1 where the displacement changed */
  int head_changed;
  int local_changed; /* whether eyes, pupils or tongue moved */
} semblante_group_pose;

/* Deforms all groups; returns the number of written vertices. */
typedef uint32_t (*semblante_deform_groups)(const semblante_prepared_face* face, const semblante_group_pose* pose,
                                            float* positions);

/* The loop compiled for one register size. */
typedef struct semblante_deform_variant {
  const char* name;
  uint32_t group_size; /* of the faces that it deforms */
  semblante_deform_groups run;
} semblante_deform_variant;

/* The *count variants that this machine supports, the fastest last. Faces are prepared for that. */
const semblante_deform_variant* semblante_deform_variants(uint32_t* count);

/* semblante_prepared_size and semblante_prepare_for for the variants of one size of groups, 8 or 16. */
size_t semblante_prepared_size_by(uint32_t group_size, const semblante_face* face);
const semblante_prepared_face* semblante_prepare_by(uint32_t group_size, const semblante_face* face,
                                                    const semblante_rig* rig, void* memory);

/* semblante_deform_prepared by the given variant, of a face that is prepared for its size of groups. */
void semblante_deform_by(const semblante_deform_variant* variant, const semblante_prepared_face* face,
                         const semblante_pose* pose, float* positions);

uint32_t semblante_deform_groups_plain(const semblante_prepared_face* face, const semblante_group_pose* pose,
                                       float* positions);
#if defined(__x86_64__)
uint32_t semblante_deform_groups_avx2(const semblante_prepared_face* face, const semblante_group_pose* pose,
                                      float* positions);
uint32_t semblante_deform_groups_avx512(const semblante_prepared_face* face, const semblante_group_pose* pose,
                                        float* positions);
#endif

#endif

/* The per-frame kernel: face parameters -> feature points (Eq. 5, 6) -> vertices (Eq. 7, then pupils, eyes, lids and
 * tongue, then the head).
 *
 * Freestanding C99: no heap, no libm, no mutable globals; every function may run on any thread. The same source is
 * the native library, the WebAssembly module and the phones' build, with bit-identical results on all of them: the
 * order of every sum is fixed and no operations are fused.
 *
 * Axes: right-handed, +X to the face's own left, +Y up, +Z out of the face. Lengths are in model units.
 * Feature points (FPs) are dense indices 0..83 in the order of the standard: by group, then number (2.1 is 0).
 */
#ifndef SEMBLANTE_KERNEL_H
#define SEMBLANTE_KERNEL_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SEMBLANTE_FP_COUNT 84
#define SEMBLANTE_FAP_COUNT 68
#define SEMBLANTE_VISEME_COUNT 15
#define SEMBLANTE_EXPRESSION_COUNT 7 /* 0 is "none" */
#define SEMBLANTE_FAPU_COUNT 5       /* IRISD, ES, ENS, MNS, MW, in this order */
#define SEMBLANTE_BLEND_MAX 63       /* full blend or intensity in FAPs 1 and 2 */
#define SEMBLANTE_BALL_PLACES 17     /* at which the radius of an eyeball is sampled, pole to equator */
#define SEMBLANTE_TURN_FULL 255      /* of semblante_face.turn: the vertex has the whole rotation of the head */
/* The rigid motion of a vertex after Eq. 7 and before the head's rotation, by its part. */
#define SEMBLANTE_RIGID_NONE 0
#define SEMBLANTE_RIGID_LEFT_EYE 1
#define SEMBLANTE_RIGID_RIGHT_EYE 2
#define SEMBLANTE_RIGID_LEFT_IRIS 3 /* rotates with its eye, after the motion of the iris */
#define SEMBLANTE_RIGID_RIGHT_IRIS 4
#define SEMBLANTE_RIGID_LEFT_LIDS 5 /* rolls on the eyeball */
#define SEMBLANTE_RIGID_RIGHT_LIDS 6
#define SEMBLANTE_RIGID_COUNT 7
#define SEMBLANTE_RIGID_TONGUE \
  128 /* 128..255: has (value - 127) / 128 of the tongue's roll; 255 is the tongue itself */

/* One frame of face parameters: the complete state. All zero is the neutral face. 284 bytes. */
typedef struct semblante_frame {
  /* FAP 1: (viseme_blend/63) of viseme1 + (1 - viseme_blend/63) of viseme2. 0..14; larger numbers have no effect. */
  uint8_t viseme1, viseme2, viseme_blend;
  /* FAP 2: (intensity1/63) of expression1 + (intensity2/63) of expression2. 0 none, 1..6; larger numbers: none. */
  uint8_t expression1, intensity1, expression2, intensity2;
  uint8_t reserved; /* 0 */
  /* fap[n] is FAP n in FAP units (rotations: 1e-5 rad), finite; 0 is absent. fap[0..2] are not read. */
  float fap[SEMBLANTE_FAP_COUNT + 1];
} semblante_frame;

/* The iris of one eye on the neutral face. 24 bytes. */
typedef struct semblante_iris {
  float axis[3];      /* unit vector from the eye's pivot through the middle of the pupil */
  float pupil_radius; /* 0: this eye has no movable iris */
  float iris_radius;  /* more than pupil_radius */
  float bend;         /* 1 / length: at distance r from the axis the surface is bend * r * r farther along it */
} semblante_iris;

/* The tongue on the neutral face. 44 bytes. */
typedef struct semblante_tongue {
  float origin[3];  /* a point of the middle line, at half of the tongue's thickness */
  float left[3];    /* unit vector across the tongue, to the face's left */
  float up[3];      /* unit vector perpendicular to `left` and to the tongue's length */
  float half_width; /* from the middle line to a border (6.3, 6.4); 0: the head has no tongue that can roll */
  float roll_limit; /* radians: the roll is clamped to it, because the tongue would intersect itself beyond */
} semblante_tongue;

/* The lids of one eye on the neutral face. They slide round the eye's axis: the line through its pivot along x. 100
 * bytes. */
typedef struct semblante_lids {
  float gaze[3];       /* unit vector from the pivot through the pupil: the pole of `ball` */
  float slit;          /* angle about the axis between the rims in the middle, radians */
  float opening;       /* the lid closes the eye when its point moves by this; 0: the lids of this eye do not slide */
  float gaze_share[2]; /* upper, lower lid: share of the eye's pitch that the middle of the open lid follows */
  /* Distance of the eyeball's surface from the pivot, at equal steps of sqrt(1 - cosine of the angle to the pole). */
  float ball[SEMBLANTE_BALL_PLACES];
  /* A vertex rises from the ball by this share of its way: lids of few vertices are flat between them. */
  float lift;
} semblante_lids;

/* A feature point that follows another one: `share` of the displacement of `leader`, with what the leader itself
 * follows by an entry that is no choice (one step: that leader's own leader counts without what it follows). 8 bytes.
 */
typedef struct semblante_companion {
  uint8_t point, leader; /* FP indices */
  uint8_t is_choice;     /* 1: only times semblante_rig.lip_share, by the player's choice */
  uint8_t reserved;      /* 0 */
  float share;
} semblante_companion;

/* The data of one model for evaluating frames. The caller owns the arrays, which must outlive the calls. */
typedef struct semblante_rig {
  const float* viseme;              /* 15 by 84 by 3: displacement sets; may be null: FAP 1 moves nothing */
  const float* expression;          /* 7 by 84 by 3, entry 0 all zero; may be null: FAP 2 moves nothing */
  float fapu[SEMBLANTE_FAPU_COUNT]; /* already divided by 1024; 0: unknown, and FAPs in that unit do nothing */
  float eye_pivot[2][3];            /* left, right */
  float head_pivot[3];
  float viseme_share;     /* share of the viseme at an FP that an expression also moves (Eq. 5): 0.85 */
  semblante_iris iris[2]; /* left, right */
  semblante_tongue tongue;
  const semblante_companion* companion; /* companion_count; may be null if that is 0 */
  uint32_t companion_count;
  float lip_share; /* whether FAP 3 alone takes the lower lip along: 0 no, as in the standard; 1 as on a human face */
  semblante_lids lids[2]; /* left, right */
} semblante_rig;

/* A pose: displacements of the FPs and motions of the rigid parts. Poses can be interpolated linearly. All members are
 * floats. The pivots, `iris`, `tongue` and `lids` are copied from the rig. */
typedef struct semblante_pose {
  float fp[SEMBLANTE_FP_COUNT * 3]; /* displacement of each FP */
  float eye_rotation[2][4];         /* left, right; unit quaternions x, y, z, w */
  float eye_translation[2][3];
  float head_rotation[4];
  float eye_pivot[2][3];
  float head_pivot[3];
  float pupil_growth[2]; /* left, right: change of the pupil's radius */
  float tongue_roll;     /* radians by which a border of the tongue rotates upwards */
  semblante_iris iris[2];
  semblante_tongue tongue;
  float lid_closure[2][2]; /* left, right; upper, lower: share of the slit that the lid has closed, sum at most 1 */
  semblante_lids lids[2];
} semblante_pose;

/* A mesh with its influence table, one row per vertex: entries row_offsets[v] .. row_offsets[v + 1] - 1.
 * Not validated: the reader of a table must check that offsets do not decrease, points are < 84 and rigid is one of
 * the values above. */
typedef struct semblante_face {
  uint32_t vertex_count;
  const float* rest;           /* #V by 3: the neutral face */
  const uint32_t* row_offsets; /* #V + 1 */
  const uint8_t* row_points;   /* #entries, FP index */
  const float* row_weights;    /* #entries, the quotient W_iP / sum of W_iP of Eq. 7 */
  const uint8_t* rigid;        /* #V of SEMBLANTE_RIGID_*, or null: none */
  const uint8_t* turn;         /* #V, 255ths of the head's rotation, or null: all turn fully */
} semblante_face;

/* Frame -> pose.
 * FAPs 1 and 2 are blended first. An FP that both move is displaced by viseme_share * viseme + (1 - viseme_share) *
 * expression (Eq. 5); an FP that only one of them moves is displaced by that one. A nonzero low-level FAP then replaces
 * the displacement of its FP on its own axis by value * FAPU (Eq. 6). Then companions follow their leaders.
 * FAPs 19..22 and the eyes' pitch close the lids.
 * FAPs 23..26 rotate the eyes about their pivots: yaw after pitch; 27 and 28 move them along z.
 * FAPs 29 and 30: value * IRISD is the growth of the pupil's diameter. The pupil keeps at least a tenth of its radius,
 * and the iris around it a tenth of its width.
 * FAP 47: the upward angle of the tongue's borders, negative downwards, clamped to the rig's limit.
 * FAPs 48..50 rotate the head: roll first, then pitch, then yaw. */
void semblante_evaluate(const semblante_rig* rig, const semblante_frame* frame, semblante_pose* pose);

/* Interpolates between poses a and b of one model, 0 <= t <= 1 (clamped): displacements, pupils, lids and roll
 * linearly, rotations along the shorter arc. `out` may be a or b. */
void semblante_interpolate(const semblante_pose* a, const semblante_pose* b, float t, semblante_pose* out);

/* Pose -> vertices: positions[v] = rest[v] + sum of weight * displacement over the row of v (Eq. 7), then the rigid
 * motion for the vertices of eyes, lids and tongue, then the head's by each vertex's share of it. positions: #V by 3,
 * must not overlap the face. Iris: moves outwards from the axis, in the eye's own frame, before the eye rotates. A
 * point at the pupil's rim moves by pupil_growth, a point at the centre of the pupil or at the rim of the iris by 0,
 * others proportionally; the surface keeps its shape. Tongue: bent like a sheet about its middle line, which stays. A
 * point at a border rotates by tongue_roll, others in proportion to their distance from the middle line; points beyond
 * the border continue along the tangent. Lids: the height that Eq. 7 gives them, on their circle round the
 * eye's axis and off the eyeball. A neutral pose gives the rest positions bit for bit. */
void semblante_deform(const semblante_face* face, const semblante_pose* pose, float* positions);

/* Sine and cosine of an angle in radians, |angle| < 1e6, to 1e-7: the same bits on every machine. Beyond: 0 and 1. */
void semblante_sincos(float angle, float* sine, float* cosine);

#ifdef __wasm__
/* Memory for JavaScript: 16-byte aligned, not zeroed; null when the memory is exhausted. Growth detaches the typed
 * arrays that view the memory: create them again after a call. */
void* semblante_alloc(uint32_t bytes);
/* Frees all memory of semblante_alloc. */
void semblante_free_all(void);
#endif

#ifdef __cplusplus
}
#endif

#endif

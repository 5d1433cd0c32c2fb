/* The C SDK of Semblante: computes the moving vertices of a face package.
 *
 * The caller fetches the package (HTTP), decodes mesh.drc (Draco) and passes the bytes. From then on: frame in,
 * positions out. No network, no files, no threads, no logging, no locale, no callbacks; no exception ever crosses this
 * boundary. Options and structs are valid when zeroed.
 *
 *   semblante_package package = {0};
 *   package.positions = positions;  package.vertex_count = n;   // decoded mesh.drc, in decoded order
 *   package.weights = weights;      package.weights_size = ...; // bytes of `weights`
 *   package.rig_json = rig;         package.rig_json_size = ...;// bytes of `rig.json`
 *   semblante_head* head;
 *   if (semblante_head_create(&package, NULL, &head, &error) != SEMBLANTE_OK) { puts(error.message); ... }
 *   semblante_frame frame = {0};
 *   frame.fap[3] = 300;                                         // open the jaw
 *   semblante_head_set_frame(head, &frame);
 *   semblante_head_positions(head, out, 3 * n);                 // draw these
 *   semblante_head_destroy(head);
 *
 * Threads: functions that take a const head may run at the same time on one head; the others need exclusive access.
 * Frames and poses are the kernel's own (semblante_kernel.h); its functions are exported as well.
 */
#ifndef SEMBLANTE_H
#define SEMBLANTE_H

#include <stddef.h>
#include <stdint.h>

#include "core/kernel/semblante_ease.h"
#include "core/kernel/semblante_kernel.h"
#include "core/kernel/semblante_normals.h"
#include "core/kernel/semblante_prepared_face.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SEMBLANTE_SDK_VERSION 0x000100u /* 0.1.0: 8 bits each */

/* Result codes. Values never change; new ones are added at the end. */
typedef enum semblante_result {
  SEMBLANTE_OK = 0,
  SEMBLANTE_INVALID_ARGUMENT = 1, /* a null that is not allowed, a number that is not finite or out of range */
  SEMBLANTE_MALFORMED = 2,        /* the bytes do not follow their format, or end early */
  SEMBLANTE_UNSUPPORTED = 3,      /* a version this SDK does not read */
  SEMBLANTE_MISMATCH = 4,         /* mesh, weights and rig do not belong to one package */
  SEMBLANTE_TOO_LARGE = 5,        /* over a documented limit (4 million vertices, 48 million weights) */
  SEMBLANTE_BUFFER_TOO_SMALL = 6, /* nothing was written */
  SEMBLANTE_OUT_OF_MEMORY = 7,
  SEMBLANTE_INTERNAL = 8
} semblante_result;

/* Text for display, zero-terminated UTF-8, truncated to fit. `where` names the member or byte at fault; may be empty.
 */
typedef struct semblante_error {
  char where[96];
  char message[256];
} semblante_error;

/* The decoded parts of a face package. Read during the call only; everything needed is copied. */
typedef struct semblante_package {
  const float* positions; /* #V by 3, model units: POSITION of mesh.drc in decoded order */
  uint32_t vertex_count;  /* #V */
  const uint8_t*
      mesh_sha256;        /* 32 bytes: SHA-256 of the bytes of mesh.drc; null: the pairing is checked by count only */
  const uint8_t* weights; /* bytes of the artefact `weights` */
  size_t weights_size;
  const char* rig_json; /* bytes of rig.json, UTF-8, need not end in zero */
  size_t rig_json_size;
  /* For semblante_head_normals; all null and 0 if the caller does not use it. */
  const uint32_t* triangles; /* #T by 3: faces of mesh.drc in decoded order */
  uint32_t triangle_count;   /* #T */
  const float* normals;      /* #V by 3: NORMAL of mesh.drc */
} semblante_package;

typedef struct semblante_head_options {
  float viseme_share;     /* share of the viseme at an FP that an expression also moves (Eq. 5); 0: that of rig.json; a
                             share of 0 is set by semblante_head_set_viseme_share */
  uint32_t jaw_takes_lip; /* 1: FAP 3 alone takes the lower lip along, as on a human face; 0: not, as in the standard.
                             FAPs of the lip itself win in both cases. */
  uint32_t reserved[6];
} semblante_head_options;

/* One parametrized head and its current pose. */
typedef struct semblante_head semblante_head;

/* Version of the loaded library, to compare with SEMBLANTE_SDK_VERSION. */
uint32_t semblante_sdk_version(void);
/* "ok", "malformed", ...: a static string for logs. */
const char* semblante_result_name(semblante_result result);

/* Makes a head in the neutral pose. `options` and `error` may be null. On failure *head is null and *error, if given,
 * has the reason. */
semblante_result semblante_head_create(const semblante_package* package, const semblante_head_options* options,
                                       semblante_head** head, semblante_error* error);
/* Accepts null. */
void semblante_head_destroy(semblante_head* head);

/* 0 for null. */
uint32_t semblante_head_vertex_count(const semblante_head* head);
/* The displacement sets of FAPs 1 and 2, units and pivots of this head; valid until it is destroyed. Null for null. */
const semblante_rig* semblante_head_rig(const semblante_head* head);
/* Rest positions and influence table; valid until the head is destroyed. Null for null. */
const semblante_face* semblante_head_face(const semblante_head* head);

/* Sets the share of the viseme at an FP that an expression also moves (Eq. 5), 0..1 inclusive, for example that of the
 * header of a stream. It applies to frames set from now on; the current pose does not change. semblante_head_rig has
 * the current share, initially that of rig.json or of the options. INVALID_ARGUMENT, without a change, for a share
 * outside 0..1 or NaN. */
semblante_result semblante_head_set_viseme_share(semblante_head* head, float viseme_share);

/* Frame -> pose of this head (Eq. 5, 6), kept in the head. FAPs that are not finite are refused. */
semblante_result semblante_head_set_frame(semblante_head* head, const semblante_frame* frame);
/* Sets the pose at t (0..1) between two frames, for displays faster than the stream. */
semblante_result semblante_head_set_interpolated(semblante_head* head, const semblante_frame* from,
                                                 const semblante_frame* to, float t);
/* Gets the current pose, or sets one made by the caller (a blend, a filter). */
semblante_result semblante_head_get_pose(const semblante_head* head, semblante_pose* pose);
semblante_result semblante_head_set_pose(semblante_head* head, const semblante_pose* pose);

/* The vertices of the current pose (Eq. 7, then eyes and tongue, then head): 3 * vertex_count floats, in decoded order.
 * `capacity` is in floats. */
semblante_result semblante_head_positions(const semblante_head* head, float* positions, size_t capacity);

/* Like semblante_head_positions, if `positions` still has the result of this head in the pose `before`: writes only
 * vertices that may differ between the two poses. For speech without head motion these are about half of all. */
semblante_result semblante_head_update_positions(const semblante_head* head, const semblante_pose* before,
                                                 float* positions, size_t capacity);

/* Unit normals of `positions` from this head: both 3 * #V floats, `capacity` of `normals`. Seams are smooth, hard edges
 * stay hard. INVALID_ARGUMENT for a head whose package was given without triangles and normals. */
semblante_result semblante_head_normals(const semblante_head* head, const float* positions, float* normals,
                                        size_t capacity);

/* ARKit's 52 blend shape coefficients, in the order of Live Link Face's stream (core/bridges/data/arkit.json), 0..1:
 * values outside are clamped. NaN and infinity are refused, and `where` names the shape. `error` may be null. */
semblante_result semblante_frame_from_arkit(const float coefficients[52], semblante_frame* frame,
                                            semblante_error* error);
/* ARKit's coefficients for the face of a frame, each in 0..1. FAPs that are not finite are refused. */
semblante_result semblante_arkit_from_frame(const semblante_frame* frame, float coefficients[52]);
/* The 15 visemes of Oculus Lipsync, in its order, which is that of FAP 1: sets FAP 1 of the frame and clears the rest.
 */
semblante_result semblante_frame_from_oculus(const float weights[15], semblante_frame* frame, semblante_error* error);
/* The weights of a frame's viseme, at least 0, with sum 1. FAPs that are not finite are refused. */
semblante_result semblante_oculus_from_frame(const semblante_frame* frame, float weights[15]);

#ifdef __cplusplus
}
#endif

#endif

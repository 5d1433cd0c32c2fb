/* A face prepared for fast deformation: the influence table of semblante_face is regrouped once, so that a frame costs
 * little more than reading the table and writing the vertices. The results are bit-identical to semblante_deform, on
 * every machine and instruction set.
 *
 *   const size_t size = semblante_prepared_size(&face);
 *   void* memory = aligned_alloc(64, size);
 *   const semblante_prepared_face* prepared = semblante_prepare_for(&face, &rig, memory);
 *   ... each frame: semblante_deform_prepared(prepared, &pose, positions);
 *
 * Vertices keep their order and numbers. Eight or sixteen consecutive vertices form a group with one list of feature
 * points, the union of their rows; missing points have the weight zero. Neighbours in a mesh decoded by Draco share
 * most of their points, so that the union is only slightly longer than the rows. Groups with equal numbers of points
 * are processed together.
 */
#ifndef SEMBLANTE_PREPARED_FACE_H
#define SEMBLANTE_PREPARED_FACE_H

#include <stddef.h>
#include <stdint.h>

#include "core/kernel/semblante_kernel.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Stored in the caller's memory, which must stay unchanged and in place; the original semblante_face may be freed. */
typedef struct semblante_prepared_face semblante_prepared_face;

/* Bytes that semblante_prepare and semblante_prepare_for need, a multiple of 64. 0: the table cannot be prepared,
 * because the points of a row are not increasing (semblante_deform accepts any order). */
size_t semblante_prepared_size(const semblante_face* face);

/* `memory`: semblante_prepared_size(face) bytes, 64-byte aligned (WebAssembly: 16). Takes the time of about ten frames.
 */
const semblante_prepared_face* semblante_prepare(const semblante_face* face, void* memory);

/* Likewise, and computes once what a frame of a pose by `rig` would compute anew for each vertex of a lid: its distance
 * from the eyeball at rest. The face can be deformed by any pose, also of other eyes; those of `rig` are faster. `rig`
 * may be null; it is copied as far as it is needed. */
const semblante_prepared_face* semblante_prepare_for(const semblante_face* face, const semblante_rig* rig,
                                                     void* memory);

/* Like semblante_deform: all #V by 3 positions, with the alignment of a float, not overlapping the face. */
void semblante_deform_prepared(const semblante_prepared_face* face, const semblante_pose* pose, float* positions);

/* Updates only vertices that may differ between two poses: `positions` must contain the result of `before` and becomes
 * the result of `now`, bit for bit. Groups whose feature points and part did not change are skipped; if the head
 * rotates, all vertices are updated. Returns the number of written vertices. */
uint32_t semblante_deform_changed(const semblante_prepared_face* face, const semblante_pose* before,
                                  const semblante_pose* now, float* positions);

#ifdef __cplusplus
}
#endif

#endif

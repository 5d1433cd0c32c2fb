/* A face laid out for speed: the influence table of semblante_face regrouped once, so that a frame costs little more
 * than reading it and writing the vertices. Gives the bits of semblante_deform, on every machine and by every kind of
 * register.
 *
 *   const size_t size = semblante_prepared_size(&face);
 *   void* memory = aligned_alloc(64, size);
 *   const semblante_prepared_face* prepared = semblante_prepare(&face, memory);
 *   ... each frame: semblante_deform_prepared(prepared, &pose, positions);
 *
 * Vertices keep their order and numbers. Eight in a row form a group with one list of feature points, the union of
 * their rows; where a row has no such point its weight is zero. Neighbours in a mesh as Draco decodes it share most of
 * their points, so that the union is hardly longer than the rows. Groups of equally many points are worked through one
 * after the other.
 */
#ifndef SEMBLANTE_PREPARED_FACE_H
#define SEMBLANTE_PREPARED_FACE_H

#include <stddef.h>
#include <stdint.h>

#include "core/kernel/semblante_kernel.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Lies in the caller's memory, which it needs whole and unmoved; the semblante_face it was made from may go. */
typedef struct semblante_prepared_face semblante_prepared_face;

/* Bytes that semblante_prepare needs, a multiple of 64. 0: the table cannot be prepared, since the points of a row do
 * not rise (semblante_deform takes any order). */
size_t semblante_prepared_size(const semblante_face* face);

/* `memory`: semblante_prepared_size(face) bytes, 64-byte aligned (WebAssembly: 16). Takes as long as some ten frames.
 */
const semblante_prepared_face* semblante_prepare(const semblante_face* face, void* memory);

/* As semblante_deform: all #V by 3 positions. They may have any alignment of a float and must not overlap the face. */
void semblante_deform_prepared(const semblante_prepared_face* face, const semblante_pose* pose, float* positions);

/* The vertices that may differ between two poses, alone: `positions` holds what `before` gave and becomes what `now`
 * gives, bit for bit. Groups whose feature points and part did not change are left alone; when the head turns, all
 * move. Returns how many vertices were written. */
uint32_t semblante_deform_changed(const semblante_prepared_face* face, const semblante_pose* before,
                                  const semblante_pose* now, float* positions);

#ifdef __cplusplus
}
#endif

#endif

/* Normals of a deformed face, from its triangles.
 *
 * Every corner adds its triangle's normal, weighted by N. Max's weights ("Weights for Computing Vertex Normals from
 * Facet Normals", 1999): exact on a sphere, nearly independent of how a surface is cut into triangles, and free of
 * trigonometry. Vertices that a UV seam splits share one normal; hard edges stay hard.
 *
 * The neutral normals of a file may differ from these: an artist set them, or the mesh has vertices between others on
 * a flat triangle. semblante_turn_normals keeps that difference while the face moves.
 */
#ifndef SEMBLANTE_NORMALS_H
#define SEMBLANTE_NORMALS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The triangles of a face. Not validated: corners must be < vertex_count, joined[v] <= v. */
typedef struct semblante_triangles {
  uint32_t vertex_count;
  uint32_t triangle_count;
  const uint32_t* corners; /* #T by 3, counter-clockwise seen from outside */
  const uint32_t* joined;  /* #V: the lowest vertex that has the same normal, often v itself */
} semblante_triangles;

/* Number of uint32_t of scratch memory for semblante_join_seams, of at most 2^30 vertices. */
size_t semblante_join_scratch(uint32_t vertex_count);

/* joined[v]: the lowest vertex with exactly the same position and normal as v on the neutral face: joins the two sides
 * of a UV seam, but not those of a hard edge. positions, normals: #V by 3, neutral. */
void semblante_join_seams(uint32_t vertex_count, const float* positions, const float* normals, uint32_t* scratch,
                          uint32_t* joined);

/* Unit normals of the deformed positions, both #V by 3; +Z for vertices without a triangle of nonzero area. */
void semblante_normals(const semblante_triangles* triangles, const float* positions, float* normals);

/* Once per face, before semblante_turn_normals. positions: #V by 3, neutral. own: #V by 3, the normals of the file on
 * the neutral face; scaled to unit length, and where they are zero replaced by those of semblante_normals. at_rest: #V
 * by 3, becomes semblante_normals of the neutral face. */
void semblante_rest_normals(const semblante_triangles* triangles, const float* positions, float* own, float* at_rest);

/* Turns the normals of the file as the surface has turned: by the smallest rotation that carries at_rest to `normals`.
 * own, at_rest: #V by 3, of semblante_rest_normals. normals: #V by 3, of semblante_normals for the deformed positions;
 * replaced by the turned ones. Of the neutral face these are the file's own, within rounding. */
void semblante_turn_normals(uint32_t vertex_count, const float* own, const float* at_rest, float* normals);

#ifdef __cplusplus
}
#endif

#endif

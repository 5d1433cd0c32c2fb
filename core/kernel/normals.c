/* See semblante_normals.h. */
#include "core/kernel/export.h"
#include "core/kernel/semblante_normals.h"

#if defined(__wasm__)
/* JavaScript uses fixed offsets of this struct (README.md): they must not change. */
_Static_assert(sizeof(semblante_triangles) == 16, "triangles");
#endif

static uint32_t table_size(uint32_t vertex_count) {
  uint32_t size = 16;
  while (size / 2 < vertex_count && size < 1U << 31) {
    size *= 2;
  }
  return size;
}

SEMBLANTE_EXPORT(semblante_join_scratch)
size_t semblante_join_scratch(uint32_t vertex_count) { return table_size(vertex_count); }

static uint32_t bits_of(float value) {
  const float positive_zero = value + 0.0F; /* -0 and 0 are the same position */
  uint32_t bits;
  __builtin_memcpy(&bits, &positive_zero, sizeof bits);
  return bits;
}

static uint32_t hash_of(const float* p) {
  uint32_t hash = 2166136261U;
  for (int i = 0; i < 3; ++i) {
    hash = (hash ^ bits_of(p[i])) * 16777619U;
    hash ^= hash >> 15;
  }
  return hash * 2654435761U;
}

static int same(const float* a, const float* b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

SEMBLANTE_EXPORT(semblante_join_seams)
void semblante_join_seams(uint32_t vertex_count, const float* positions, const float* normals, uint32_t* scratch,
                          uint32_t* joined) {
  const uint32_t none = 0xFFFFFFFFU;
  const uint32_t size = table_size(vertex_count);
  for (uint32_t i = 0; i < size; ++i) {
    scratch[i] = none;
  }
  for (uint32_t v = 0; v < vertex_count; ++v) {
    const float* const p = positions + (size_t)v * 3;
    const float* const n = normals + (size_t)v * 3;
    uint32_t at = hash_of(p) & (size - 1);
    while (scratch[at] != none &&
           !(same(positions + (size_t)scratch[at] * 3, p) && same(normals + (size_t)scratch[at] * 3, n))) {
      at = (at + 1) & (size - 1);
    }
    if (scratch[at] == none) {
      scratch[at] = v;
    }
    joined[v] = scratch[at];
  }
}

static float square(const float d[3]) { return d[0] * d[0] + d[1] * d[1] + d[2] * d[2]; }

static void add(float* to, const float by[3], float weight) {
  to[0] += weight * by[0];
  to[1] += weight * by[1];
  to[2] += weight * by[2];
}

SEMBLANTE_EXPORT(semblante_normals)
void semblante_normals(const semblante_triangles* triangles, const float* positions, float* normals) {
  for (size_t i = 0; i < (size_t)triangles->vertex_count * 3; ++i) {
    normals[i] = 0.0F;
  }
  for (uint32_t t = 0; t < triangles->triangle_count; ++t) {
    const uint32_t* const corner = triangles->corners + (size_t)t * 3;
    const float* const a = positions + (size_t)corner[0] * 3;
    const float* const b = positions + (size_t)corner[1] * 3;
    const float* const c = positions + (size_t)corner[2] * 3;
    const float ab[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const float ac[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const float bc[3] = {c[0] - b[0], c[1] - b[1], c[2] - b[2]};
    const float across[3] = {ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2],
                             ab[0] * ac[1] - ab[1] * ac[0]};
    const float ab2 = square(ab);
    const float ac2 = square(ac);
    const float bc2 = square(bc);
    if (!(ab2 > 0.0F && ac2 > 0.0F && bc2 > 0.0F)) {
      continue;
    }
    /* The weight of a corner: 1 / (product of the squared lengths of its two edges). */
    const float r_ab = 1.0F / ab2;
    const float r_ac = 1.0F / ac2;
    const float r_bc = 1.0F / bc2;
    add(normals + (size_t)triangles->joined[corner[0]] * 3, across, r_ab * r_ac);
    add(normals + (size_t)triangles->joined[corner[1]] * 3, across, r_ab * r_bc);
    add(normals + (size_t)triangles->joined[corner[2]] * 3, across, r_ac * r_bc);
  }
  for (uint32_t v = 0; v < triangles->vertex_count; ++v) {
    float* const n = normals + (size_t)v * 3;
    if (triangles->joined[v] != v) {
      const float* const from = normals + (size_t)triangles->joined[v] * 3;
      n[0] = from[0], n[1] = from[1], n[2] = from[2];
      continue;
    }
    const float length = __builtin_sqrtf(square(n));
    if (length > 0.0F) {
      n[0] /= length, n[1] /= length, n[2] /= length;
    } else {
      n[0] = 0.0F, n[1] = 0.0F, n[2] = 1.0F;
    }
  }
}

SEMBLANTE_EXPORT(semblante_rest_normals)
void semblante_rest_normals(const semblante_triangles* triangles, const float* positions, float* own, float* at_rest) {
  semblante_normals(triangles, positions, at_rest);
  for (size_t i = 0; i < (size_t)triangles->vertex_count * 3; i += 3) {
    const float length = __builtin_sqrtf(square(own + i));
    for (size_t k = i; k < i + 3; ++k) {
      own[k] = length > 0.0F ? own[k] / length : at_rest[k];
    }
  }
}

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

SEMBLANTE_EXPORT(semblante_turn_normals)
void semblante_turn_normals(uint32_t vertex_count, const float* own, const float* at_rest, float* normals) {
  for (size_t i = 0; i < (size_t)vertex_count * 3; i += 3) {
    const float* const v = own + i;
    const float* const a = at_rest + i;
    float* const b = normals + i;
    const float opposite = 1.0F + dot(a, b);
    if (!(opposite > 1e-4F)) {
      continue; /* turned over: every rotation by half a turn is as small, and the triangles' own normal is kept */
    }
    /* The smallest rotation that carries unit a to unit b: v - (a + b) ((a + b) v) / (1 + a b) + 2 b (a v). */
    const float along = dot(a, v);
    const float of_sum = (along + dot(b, v)) / opposite;
    for (int k = 0; k < 3; ++k) {
      b[k] = v[k] - of_sum * a[k] + (2.0F * along - of_sum) * b[k];
    }
  }
}

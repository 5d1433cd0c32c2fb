/* Internal: numbers of SEMBLANTE_LANES vertices at once, one vertex per lane of a register. The including file defines
 * SEMBLANTE_LANES as 1 (plain floats), 4 (SSE2, NEON, WebAssembly SIMD), 8 (AVX2) or 16 (AVX-512). A formula that is
 * written with these types gives the same bits with every number of lanes: each lane does the same operations in the
 * same order. */
#ifndef SEMBLANTE_KERNEL_LANES_H
#define SEMBLANTE_KERNEL_LANES_H

#include <stdint.h>

#if SEMBLANTE_LANES >= 8
#include <immintrin.h>
#elif SEMBLANTE_LANES == 4 && defined(__SSE2__)
#include <emmintrin.h>
#elif SEMBLANTE_LANES == 4 && defined(__aarch64__)
#include <arm_neon.h>
#endif

#define LANE_FUNCTION static inline __attribute__((always_inline, unused))

#if SEMBLANTE_LANES == 1
typedef float reg;
typedef int32_t ints;
typedef int32_t mask; /* which lanes: by less() and its like; combined with & and | */
#else
typedef float reg __attribute__((vector_size(4 * SEMBLANTE_LANES)));
typedef int32_t ints __attribute__((vector_size(4 * SEMBLANTE_LANES)));
#if SEMBLANTE_LANES == 16
typedef __mmask16 mask;
#else
typedef ints mask;
#endif
#endif

LANE_FUNCTION reg all_lanes(float x) {
#if SEMBLANTE_LANES == 1
  return x;
#else
  return x - (reg){0}; /* x itself, also minus zero */
#endif
}

/* Comparisons, of which none but `differs` holds for what is not a number. */
#if SEMBLANTE_LANES == 16
LANE_FUNCTION mask less(reg a, reg b) { return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ); }
LANE_FUNCTION mask at_least(reg a, reg b) { return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_GE_OQ); }
LANE_FUNCTION mask differs(reg a, reg b) { return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_NEQ_UQ); }
LANE_FUNCTION mask equals(ints a, int32_t b) { return _mm512_cmpeq_epi32_mask((__m512i)a, _mm512_set1_epi32(b)); }
#else
LANE_FUNCTION mask less(reg a, reg b) { return a < b; }
LANE_FUNCTION mask at_least(reg a, reg b) { return a >= b; }
LANE_FUNCTION mask differs(reg a, reg b) { return a != b; }
LANE_FUNCTION mask equals(ints a, int32_t b) { return a == b; }
#endif

/* The lanes of `yes` where `where` holds, those of `no` elsewhere. */
LANE_FUNCTION reg choose(mask where, reg yes, reg no) {
#if SEMBLANTE_LANES == 1
  return where ? yes : no;
#elif SEMBLANTE_LANES == 16
  return (reg)_mm512_mask_blend_ps(where, (__m512)no, (__m512)yes);
#elif SEMBLANTE_LANES == 8
  return (reg)_mm256_blendv_ps((__m256)no, (__m256)yes, (__m256)where);
#else
  return (reg)((where & (mask)yes) | (~where & (mask)no));
#endif
}

/* Whether a mask holds in any lane. */
LANE_FUNCTION int any(mask where) {
#if SEMBLANTE_LANES == 1 || SEMBLANTE_LANES == 16
  return where != 0;
#elif SEMBLANTE_LANES == 8
  return _mm256_movemask_ps((__m256)where) != 0;
#elif defined(__SSE2__)
  return _mm_movemask_ps((__m128)where) != 0;
#elif defined(__aarch64__)
  return vmaxvq_u32((uint32x4_t)where) != 0;
#elif defined(__wasm_simd128__)
  typedef signed char bytes __attribute__((vector_size(16)));
  return __builtin_wasm_any_true_v128((bytes)where);
#else
  return (where[0] | where[1] | where[2] | where[3]) != 0;
#endif
}

LANE_FUNCTION reg square_root(reg x) {
#if SEMBLANTE_LANES == 1
  return __builtin_sqrtf(x);
#elif SEMBLANTE_LANES == 16
  return (reg)_mm512_sqrt_ps((__m512)x);
#elif SEMBLANTE_LANES == 8
  return (reg)_mm256_sqrt_ps((__m256)x);
#elif defined(__SSE2__)
  return (reg)_mm_sqrt_ps((__m128)x);
#elif defined(__aarch64__)
  return (reg)vsqrtq_f32((float32x4_t)x);
#elif defined(__wasm_simd128__)
  return (reg)__builtin_wasm_sqrt_f32x4(x);
#else
  return (reg){__builtin_sqrtf(x[0]), __builtin_sqrtf(x[1]), __builtin_sqrtf(x[2]), __builtin_sqrtf(x[3])};
#endif
}

/* Rounded towards zero; within the range of int32_t. */
LANE_FUNCTION ints whole(reg x) {
#if SEMBLANTE_LANES == 1
  return (int32_t)x;
#else
  return __builtin_convertvector(x, ints);
#endif
}

LANE_FUNCTION reg as_reals(ints x) {
#if SEMBLANTE_LANES == 1
  return (float)x;
#else
  return __builtin_convertvector(x, reg);
#endif
}

/* One byte of each vertex. */
LANE_FUNCTION ints load_bytes(const uint8_t* from) {
#if SEMBLANTE_LANES == 1
  return *from;
#else
  typedef uint8_t bytes __attribute__((vector_size(SEMBLANTE_LANES)));
  bytes all;
  __builtin_memcpy(&all, from, sizeof all);
  return __builtin_convertvector(all, ints);
#endif
}

/* from[index] and from[index + 1] of each lane: `from` has 17 numbers. */
LANE_FUNCTION void look_up_two(const float* from, ints index, reg* here, reg* next) {
#if SEMBLANTE_LANES == 1
  *here = from[index];
  *next = from[index + 1];
#elif SEMBLANTE_LANES == 16
  *here = (reg)_mm512_permutexvar_ps((__m512i)index, _mm512_loadu_ps(from));
  *next = (reg)_mm512_permutexvar_ps((__m512i)index, _mm512_loadu_ps(from + 1));
#elif SEMBLANTE_LANES == 8
  const mask high = index > 7;
  for (int i = 0; i < 2; ++i) {
    const __m256 low = _mm256_permutevar8x32_ps(_mm256_loadu_ps(from + i), (__m256i)index);
    const __m256 rest = _mm256_permutevar8x32_ps(_mm256_loadu_ps(from + i + 8), (__m256i)index);
    *(i == 0 ? here : next) = choose(high, (reg)rest, (reg)low);
  }
#else
  typedef float two __attribute__((vector_size(8)));
  two pair[4];
  for (int lane = 0; lane < 4; ++lane) {
    __builtin_memcpy(&pair[lane], from + index[lane], sizeof pair[lane]);
  }
  const reg first = __builtin_shufflevector(pair[0], pair[1], 0, 1, 2, 3);
  const reg second = __builtin_shufflevector(pair[2], pair[3], 0, 1, 2, 3);
  *here = __builtin_shufflevector(first, second, 0, 2, 4, 6);
  *next = __builtin_shufflevector(first, second, 1, 3, 5, 7);
#endif
}

LANE_FUNCTION reg within(reg value, float low, float high) {
  return choose(less(value, all_lanes(low)), all_lanes(low),
                choose(less(all_lanes(high), value), all_lanes(high), value));
}

LANE_FUNCTION reg dot_product(const reg a[3], const reg b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* The same with a vector that all lanes share. */
LANE_FUNCTION reg dot_with(const reg a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

#endif

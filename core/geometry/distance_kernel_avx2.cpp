// x86-64-v3: two registers of four doubles. Compiled with -mavx2; see distance_kernel_body.h for what may be included.
#include <cstddef>
#include <cstdint>
#include <immintrin.h>

namespace semblante {
namespace {

struct Lanes {
  __m256d low, high;

  static Lanes load(const double* from) { return {_mm256_load_pd(from), _mm256_load_pd(from + 4)}; }
  void store(double* to) const {
    _mm256_store_pd(to, low);
    _mm256_store_pd(to + 4, high);
  }
  void lower_to(const Lanes& other, double length) {
    const __m256d step = _mm256_set1_pd(length);
    low = _mm256_min_pd(_mm256_add_pd(other.low, step), low);
    high = _mm256_min_pd(_mm256_add_pd(other.high, step), high);
  }
  [[nodiscard]] std::uint8_t improves(const Lanes& other, double length) const {
    const __m256d step = _mm256_set1_pd(length);
    const __m256d a = _mm256_cmp_pd(_mm256_add_pd(low, step), other.low, _CMP_LT_OQ);
    const __m256d b = _mm256_cmp_pd(_mm256_add_pd(high, step), other.high, _CMP_LT_OQ);
    return static_cast<std::uint8_t>(_mm256_movemask_pd(_mm256_or_pd(a, b)) != 0);
  }
};

}  // namespace
}  // namespace semblante

#include "core/geometry/distance_kernel_body.h"

namespace semblante {
extern const DistanceKernel avx2_distance_kernel;
const DistanceKernel avx2_distance_kernel{"AVX2", sweep, sweep_list};
}  // namespace semblante

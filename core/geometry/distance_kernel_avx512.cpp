// AVX-512: one register of eight doubles. Compiled with -mavx512f; see distance_kernel_body.h for what may be included.
#include <cstddef>
#include <cstdint>
#include <immintrin.h>

namespace semblante {
namespace {

struct Lanes {
  __m512d v;

  static Lanes load(const double* from) { return {_mm512_load_pd(from)}; }
  void store(double* to) const { _mm512_store_pd(to, v); }
  void lower_to(const Lanes& other, double length) {
    v = _mm512_min_pd(_mm512_add_pd(other.v, _mm512_set1_pd(length)), v);
  }
  [[nodiscard]] std::uint8_t improves(const Lanes& other, double length) const {
    const __m512d reached = _mm512_add_pd(v, _mm512_set1_pd(length));
    return static_cast<std::uint8_t>(_mm512_cmp_pd_mask(reached, other.v, _CMP_LT_OQ) != 0);
  }
};

}  // namespace
}  // namespace semblante

#include "core/geometry/distance_kernel_body.h"

namespace semblante {
extern const DistanceKernel avx512_distance_kernel;
const DistanceKernel avx512_distance_kernel{"AVX-512", sweep, sweep_list};
}  // namespace semblante

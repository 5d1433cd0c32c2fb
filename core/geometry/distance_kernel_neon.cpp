// aarch64: four registers of two doubles. NEON is part of every such machine.
#include <arm_neon.h>
#include <cstddef>
#include <cstdint>

namespace semblante {
namespace {

struct Lanes {
  float64x2_t v[4];

  static Lanes load(const double* from) {
    return {{vld1q_f64(from), vld1q_f64(from + 2), vld1q_f64(from + 4), vld1q_f64(from + 6)}};
  }
  void store(double* to) const {
    for (std::size_t i = 0; i < 4; ++i) vst1q_f64(to + 2 * i, v[i]);
  }
  void lower_to(const Lanes& other, double length) {
    const float64x2_t step = vdupq_n_f64(length);
    for (std::size_t i = 0; i < 4; ++i) v[i] = vminq_f64(vaddq_f64(other.v[i], step), v[i]);
  }
  [[nodiscard]] std::uint8_t improves(const Lanes& other, double length) const {
    const float64x2_t step = vdupq_n_f64(length);
    uint64x2_t any = vdupq_n_u64(0);
    for (std::size_t i = 0; i < 4; ++i) any = vorrq_u64(any, vcltq_f64(vaddq_f64(v[i], step), other.v[i]));
    return static_cast<std::uint8_t>((vgetq_lane_u64(any, 0) | vgetq_lane_u64(any, 1)) & 1U);
  }
};

}  // namespace
}  // namespace semblante

#include "core/geometry/distance_kernel_body.h"

namespace semblante {
extern const DistanceKernel neon_distance_kernel;
const DistanceKernel neon_distance_kernel{"NEON", sweep, sweep_list};
}  // namespace semblante

#include "core/geometry/distance_kernel.h"

#include <array>

namespace semblante {

extern const DistanceKernel plain_distance_kernel;
#if defined(__x86_64__)
extern const DistanceKernel avx2_distance_kernel;
extern const DistanceKernel avx512_distance_kernel;
#elif defined(__aarch64__)
extern const DistanceKernel neon_distance_kernel;
#endif

std::span<const DistanceKernel> distance_kernels() {
  struct Usable {
    std::array<DistanceKernel, 3> kernels{plain_distance_kernel};
    std::size_t count = 1;
  };
  static const Usable usable = [] {
    Usable found;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") != 0) found.kernels[found.count++] = avx2_distance_kernel;
    if (__builtin_cpu_supports("avx512f") != 0) found.kernels[found.count++] = avx512_distance_kernel;
#elif defined(__aarch64__)
    found.kernels[found.count++] = neon_distance_kernel;
#endif
    return found;
  }();
  return std::span(usable.kernels).first(usable.count);
}

}  // namespace semblante

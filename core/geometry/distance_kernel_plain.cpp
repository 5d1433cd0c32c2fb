// The version in plain C++, for every machine.
#include <cstddef>
#include <cstdint>

namespace semblante {
namespace {

struct Lanes {
  double v[8];

  static Lanes load(const double* from) {
    Lanes lanes;
    for (std::size_t i = 0; i < 8; ++i) lanes.v[i] = from[i];
    return lanes;
  }
  void store(double* to) const {
    for (std::size_t i = 0; i < 8; ++i) to[i] = v[i];
  }
  void lower_to(const Lanes& other, double length) {
    for (std::size_t i = 0; i < 8; ++i) v[i] = other.v[i] + length < v[i] ? other.v[i] + length : v[i];
  }
  [[nodiscard]] std::uint8_t improves(const Lanes& other, double length) const {
    unsigned any = 0;
    for (std::size_t i = 0; i < 8; ++i) any |= static_cast<unsigned>(v[i] + length < other.v[i]);
    return static_cast<std::uint8_t>(any);
  }
};

}  // namespace
}  // namespace semblante

#include "core/geometry/distance_kernel_body.h"

namespace semblante {
extern const DistanceKernel plain_distance_kernel;
const DistanceKernel plain_distance_kernel{"plain", sweep, sweep_list};
}  // namespace semblante

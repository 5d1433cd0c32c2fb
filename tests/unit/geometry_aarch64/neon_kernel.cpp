// The NEON version of the distance kernel beside the plain one, built for aarch64 and run by an emulator: same bits.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <vector>

#include "core/geometry/distance_kernel.h"

namespace {

using semblante::DistanceGroup;

/// A grid of side x side vertices with edges of pseudo-random lengths, eight sources, swept until nothing changes.
std::vector<double> settle(const semblante::DistanceKernel& kernel, std::uint32_t side) {
  const std::uint32_t count = side * side;
  std::vector<std::uint32_t> offsets{0};
  std::vector<std::uint32_t> to;
  std::vector<double> lengths;
  const auto link = [&](std::uint32_t a, std::uint32_t b) {
    to.push_back(b);
    lengths.push_back(1.0 + std::sin(static_cast<double>(a < b ? a * 7919 + b : b * 7919 + a)) / 3.0);
  };
  for (std::uint32_t v = 0; v < count; ++v) {
    if (v % side > 0) link(v, v - 1);
    if (v % side + 1 < side) link(v, v + 1);
    if (v >= side) link(v, v - side);
    if (v + side < count) link(v, v + side);
    offsets.push_back(static_cast<std::uint32_t>(to.size()));
  }
  std::vector<std::uint32_t> same(count);
  for (std::uint32_t v = 0; v < count; ++v) same[v] = v;
  std::vector<std::uint8_t> pending(count + 8, 0);
  std::vector<double> storage(count * DistanceGroup::lane_count, std::numeric_limits<double>::infinity());
  for (std::uint32_t lane = 0; lane < DistanceGroup::lane_count; ++lane) {
    const std::uint32_t source = (lane * 7717 + 5) % count;
    storage[source * DistanceGroup::lane_count + lane] = 0.0;
    for (std::uint32_t k = offsets[source]; k < offsets[source + 1]; ++k) pending[to[k]] = 1;
  }
  const DistanceGroup group{offsets.data(), to.data(),      lengths.data(), same.data(),
                            same.data(),    pending.data(), storage.data()};
  kernel.sweep_list(group, same.data(), count, true);
  for (bool forward = false; kernel.sweep(group, count, forward) > 0;) forward = !forward;
  return storage;
}

}  // namespace

int main() {
  const auto kernels = semblante::distance_kernels();
  if (kernels.size() < 2) {
    std::puts("no version but the plain one");
    return 1;
  }
  const std::vector<double> plain = settle(kernels.front(), 40);
  for (const semblante::DistanceKernel& kernel : kernels) {
    const std::vector<double> found = settle(kernel, 40);
    if (std::memcmp(plain.data(), found.data(), plain.size() * sizeof(double)) != 0) {
      std::printf("%s differs from the plain version\n", kernel.name);
      return 1;
    }
    std::printf("%s: the same bits\n", kernel.name);
  }
  return 0;
}

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/geometry/distance_kernel.h"
#include "core/geometry/surface.h"

namespace semblante {

struct FreeDistances {
  void operator()(double* distances) const;
};

/// Surface distances from many sources to every vertex of one part.
class DistancesFromAll {
 public:
  /// Distance from source number `source` to the part's member number `member` (the order of Surface::members_of).
  [[nodiscard]] double at(std::size_t source, std::size_t member) const {
    return lanes_[lane_of_[source] + vertex_of_[member] * DistanceGroup::lane_count];
  }
  /// The distances from every source to one member, written to `row`, which has as many places.
  void read_row(std::size_t member, std::span<double> row) const {
    for (std::size_t source = 0; source < lane_of_.size(); ++source) row[source] = at(source, member);
  }
  /// Fetches the distances of a member into the cache. Each group of sources has its own row of them, far from the
  /// others, and waiting for one row after the other takes longer than using them. Always inlined: GCC sees no effect
  /// in a prefetch, and removes calls of functions without effects.
  __attribute__((always_inline)) void prefetch(std::size_t member) const {
    for (std::size_t group = 0; group < lane_of_.size(); group += DistanceGroup::lane_count) {
      const double* const lanes =
          &lanes_[group * vertex_of_.size() + vertex_of_[member] * std::size_t{DistanceGroup::lane_count}];
      for (std::size_t lane = 0; lane < DistanceGroup::lane_count; lane += 8) __builtin_prefetch(lanes + lane);
    }
  }

 private:
  friend DistancesFromAll distances_from_all(const Surface&, PartId, std::span<const SurfaceVertexId>,
                                             const DistanceKernel&);
  std::unique_ptr<double[], FreeDistances> lanes_;  ///< #groups x #M x lane_count
  std::vector<std::size_t> lane_of_;                ///< by source: where the first vertex's distance is in `lanes_`
  std::vector<std::uint32_t> vertex_of_;            ///< by member: its number in the kernel's arrays
};

/// One search for all sources, sixteen at a time. Bit for bit the values of EdgePathSearch: the minimum, over all
/// paths, of the lengths summed from the source on in double. Relaxation until nothing changes has this result in any
/// order, because rounded addition is monotonic.
///
/// The order is chosen for speed. Sources close to each other form a group. Sweeps go over its surroundings in two
/// directions, forward and backward, then over the part outwards by straight distance, where most vertices are final at
/// the first visit; later sweeps visit only vertices that a neighbour can still improve. If winding paths make this
/// slow, each source of the group is searched separately.
///
/// Every source must be on `part`. Memory: 8 bytes per source (rounded up to sixteens) and member.
DistancesFromAll distances_from_all(const Surface& graph, PartId part, std::span<const SurfaceVertexId> sources,
                                    const DistanceKernel& kernel = distance_kernels().back());

}  // namespace semblante

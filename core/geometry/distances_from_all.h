#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/geometry/distance_kernel.h"
#include "core/geometry/surface.h"

namespace semblante {

/// Surface distances from many sources to every vertex of one part.
class DistancesFromAll {
 public:
  /// From source number `source` to the part's member number `member` (the order of Surface::members_of).
  [[nodiscard]] double at(std::size_t source, std::size_t member) const {
    return lanes_[lane_of_[source] + vertex_of_[member] * DistanceGroup::lane_count];
  }
  /// From every source to one member; `row` has a place for each source.
  void read_row(std::size_t member, std::span<double> row) const;

 private:
  friend DistancesFromAll distances_from_all(const Surface&, PartId, std::span<const SurfaceVertexId>,
                                             const DistanceKernel&);
  struct Free {
    void operator()(double* lanes) const;
  };
  std::unique_ptr<double[], Free> lanes_;  ///< #groups x #M x lane_count
  std::vector<std::size_t> lane_of_;       ///< by source: where the first vertex's distance is in `lanes_`
  std::vector<std::uint32_t> vertex_of_;   ///< by member: its number in the kernel's arrays
};

/// One search for all sources together, sixteen side by side. Bit by bit the values of EdgePathSearch: the least, over
/// all paths, of the lengths added up from the source on in double. Correcting distances until nothing changes ends
/// there in whatever order it goes, for rounded addition never falls when a summand grows.
///
/// The order is chosen for speed. Sources near each other form a group. Their surroundings are swept along and across,
/// to and fro, then the part from there outwards, by straight distance, where most vertices are final at the first
/// visit; further sweeps, back and forth, visit only what a neighbour can still improve. Where ways wind so that this
/// does not end soon, each source of the group is searched from by itself.
///
/// Every source must lie on `part`. Memory: 8 bytes a source (rounded up to sixteens) and member.
DistancesFromAll distances_from_all(const Surface& graph, PartId part, std::span<const SurfaceVertexId> sources,
                                    const DistanceKernel& kernel = distance_kernels().back());

}  // namespace semblante

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace semblante {

/// The inner loop of `distances_from_all`, compiled once per kind of register. It only adds doubles and takes minima,
/// so all versions give the same bits.
///
/// Arrays of one group of `lane_count` sources on one part. A *vertex* indexes graph and distances; a *position* is an
/// index in `order`, the order of the vertices in a sweep.
struct DistanceGroup {
  /// Number of doubles: two cache lines, so that graph and order are read half as often as with one.
  static constexpr std::size_t lane_count = 16;

  const std::uint32_t* offsets;  ///< #M + 1, into `to` and `lengths`
  const std::uint32_t* to;       ///< #A
  const double* lengths;         ///< #A
  const std::uint32_t* order;    ///< #M, position -> vertex
  const std::uint32_t* place;    ///< #M, vertex -> position
  std::uint8_t* pending;         ///< #M by position: 1 if a neighbour has a shorter way for a lane; 8 more bytes follow
  double* distances;             ///< #M x lane_count, 64-byte aligned
};

struct DistanceKernel {
  const char* name;
  /// Sweeps over the first `count` positions, forward or backward: updates every pending vertex from its neighbours,
  /// and marks the neighbours that it can improve as pending. Returns the number of vertices that were pending.
  std::size_t (*sweep)(const DistanceGroup& group, std::size_t count, bool forward);
  /// Sweeps over a list of positions.
  std::size_t (*sweep_list)(const DistanceGroup& group, const std::uint32_t* positions, std::size_t count,
                            bool forward);
};

/// The versions supported by this machine: the plain one first, the fastest last.
std::span<const DistanceKernel> distance_kernels();

}  // namespace semblante

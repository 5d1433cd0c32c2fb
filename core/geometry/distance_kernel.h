#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace semblante {

/// The inner loop of `distances_from_all`, compiled once per kind of register. It adds and takes minima of doubles and
/// does nothing else, so every version gives the same bits.
///
/// Arrays of one group of `lane_count` sources on one part. A *vertex* indexes graph and distances; a *position* is its
/// place in `order`, the order in which a sweep goes over the part.
struct DistanceGroup {
  /// Doubles: two cache lines, so that graph and order are read half as often as with one.
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
  /// Goes over the first `count` positions, forward or back, and brings every pending vertex up to date with its
  /// neighbours; marks those that it can improve in turn. Returns how many were pending.
  std::size_t (*sweep)(const DistanceGroup& group, std::size_t count, bool forward);
  /// The same over a list of positions.
  std::size_t (*sweep_list)(const DistanceGroup& group, const std::uint32_t* positions, std::size_t count,
                            bool forward);
};

/// The versions that this machine can run: the plain one first, the fastest last.
std::span<const DistanceKernel> distance_kernels();

}  // namespace semblante

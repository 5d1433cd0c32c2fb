#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/surface.h"

namespace semblante {

/// Surface distance along mesh edges: one search gives the distances from one vertex to all
/// others. Keeps its arrays between searches, so that 84 searches allocate once.
class EdgePathSearch {
 public:
  explicit EdgePathSearch(const Surface& surface);  ///< keeps a reference

  /// #S distances from `source`; infinite for unreachable vertices. Valid until the next call.
  ///
  /// The value is the minimum, over all paths, of the lengths summed from `source` on in double: it does not depend on
  /// the order of vertices or edges.
  std::span<const double> from(SurfaceVertexId source) { return from(std::span(&source, 1)); }

  /// Distances from the nearest of several sources, possibly on different parts. Without sources all are infinite.
  std::span<const double> from(std::span<const SurfaceVertexId> sources);

 private:
  struct Entry {
    double distance;
    std::uint32_t vertex;
  };
  /// Lowers the distances of the neighbours of a vertex whose own one is final.
  void go_on_from(std::uint32_t vertex);

  const Surface& surface_;
  std::vector<double> distances_;
  std::vector<Entry> pending_;   ///< a heap, least distance on top; may hold entries that a shorter way made stale
  std::vector<PartId> touched_;  ///< the parts whose distances are not infinite
};

}  // namespace semblante

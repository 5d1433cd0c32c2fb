#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/distances_from_all.h"
#include "core/geometry/surface.h"

namespace semblante {

/// Surface distances d(f, P) between the feature points of one part and its vertices. A vertex reaches only the points
/// of its own part, so parts are processed one after another: memory is #members x #points of the largest.
struct PointDistances {
  std::vector<SurfacePoint> points;          ///< #F on this part, in rising order of id; a *slot* indexes them
  std::span<const SurfaceVertexId> members;  ///< #M vertices of the part
  DistancesFromAll to_members;               ///< distances from every slot to every member
  std::vector<double> between;               ///< #F x #F, d_ij; symmetric

  [[nodiscard]] double at(std::size_t slot, std::size_t member) const { return to_members.at(slot, member); }
  /// Fetches the distances of a member some places ahead: calls are for one member after the other.
  __attribute__((always_inline)) void fetch_after(std::size_t member) const {
    constexpr std::size_t ahead = 4;
    if (member + ahead < members.size()) to_members.prefetch(member + ahead);
  }
  /// All #F of a member, in `row`.
  std::span<const double> of_member(std::size_t member, std::vector<double>& row) const {
    row.resize(points.size());
    fetch_after(member);
    to_members.read_row(member, row);
    return row;
  }
  [[nodiscard]] double between_points(std::size_t i, std::size_t j) const { return between[i * points.size() + j]; }
};

/// `points` of other parts are omitted. `graph` defines the paths: the surface itself, or the same vertices and parts
/// with other edges.
PointDistances measure_distances(const Surface& graph, PartId part, std::span<const SurfacePoint> points);

}  // namespace semblante

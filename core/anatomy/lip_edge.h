#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"

namespace semblante {

/// The inner edge of a lip from the right corner of the mouth to the left one, through its points.
struct LipEdge {
  std::array<const SurfacePoint*, 5> points{};  ///< corner, beside, middle, beside, corner; null: not on the surface
  /// Vertices from each point to the next, with both; empty if one of them is missing. Where the mouth is a hole in the
  /// surface, the edge is the border of that hole, even if points lie beside it: on a coarse mesh the nearest vertex to
  /// a point may be one of the outer lip. Elsewhere it is the shortest path.
  std::array<std::vector<SurfaceVertexId>, 4> between;
};

struct LipEdges {
  LipEdge upper, lower;
};

/// The border of the hole that a mouth is in the surface, along both lips; empty where the mouth is no hole.
std::vector<SurfaceVertexId> border_of_mouth(const Surface& surface, std::span<const SurfacePoint> points);

/// The edges of both lips. Keeps pointers to `points`.
LipEdges find_lip_edges(const Surface& surface, std::span<const SurfacePoint> points);

}  // namespace semblante

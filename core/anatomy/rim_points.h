#pragma once

#include <span>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/tables/openings.h"

namespace semblante {

/// A point of one lip or lid whose vertex is on the other one.
struct MisplacedRimPoint {
  SurfacePoint point;
  const mpeg4::Opening* opening = nullptr;
  bool is_upper = false;        ///< the side to which the point belongs
  SurfaceVertexId nearest_own;  ///< the nearest vertex without a point on the right side
};

/// The points of lips and lids that are certainly on the wrong side of their opening. The sides are determined along
/// the surface (RimSides) by the points beside the opening only, because those of the rims may be wrong. Rims that are
/// joined have no certain side, so no point of theirs is reported.
std::vector<MisplacedRimPoint> find_misplaced_rim_points(const Surface& surface, std::span<const SurfacePoint> points);

/// Whether one of the points is misplaced.
bool is_misplaced(std::span<const MisplacedRimPoint> misplaced, FeaturePointId id);

}  // namespace semblante

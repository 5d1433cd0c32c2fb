#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"

namespace semblante {

/// A place on the edge of a lip or lid, between feature points, that moves as a mix of theirs.
struct MarginSite {
  SurfaceVertexId vertex;
  std::vector<std::pair<FeaturePointId, double>> shares;  ///< positive, sum 1
};

/// Places along the edges of lips and lids, which define for the smooth weights how an edge moves between its few
/// points:
///
/// - A lid's edge is moved by its middle (3.1 to 3.4) in the measure of the eye's opening there: where the eye is open
///   half as high as IRISD0, half as far; the rest is the corners' share. So FAPs 19 to 22 shut the eye along its whole
///   edge and not in the middle alone, and upper and lower lid that each go part of the way meet.
/// - An inner edge of a lip goes evenly from point to point; both lips in the same measure, so that lips which touch
///   and move alike go on touching.
///
/// Edges are shortest paths between the points that bound them; edges whose points are missing have no places. A lid
/// on a part without corners (a shell behind the fold) ends at its vertices nearest to them.
std::vector<MarginSite> margin_sites(const Surface& surface, std::span<const SurfacePoint> points);

}  // namespace semblante

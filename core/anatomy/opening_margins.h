#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/anatomy/modelled_eye.h"
#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"

namespace semblante {

/// A vertex on the edge of a lip or lid or on the fold of an upper lid, between feature points, that moves by a
/// weighted mean of their displacements.
struct MarginSite {
  SurfaceVertexId vertex;
  std::vector<std::pair<FeaturePointId, double>> shares;  ///< positive, sum 1
  /// The vertex has points of both lips, or of one on the line of both, or is the middle of a lid of a slanted eye: it
  /// follows these shares instead.
  bool replaces_points = false;
  bool is_edge = true;  ///< else on a fold
};

/// Places along the edges of lips and lids and the folds of upper lids. They define for the smooth weights how an edge
/// or a fold moves between its few points:
///
/// - Edge of a lid: the share of its middle point (3.1 to 3.4) is the height of the eye's opening at the place divided
///   by that in the middle; the corners have the rest. So FAPs 19 to 22 close the eye along the whole edge instead of
///   only in the middle, and upper and lower lid meet even if each moves only part of the way. At the outer corner an
///   upper lid that lies in front of the lower one overlaps it, so that the eye is closed as seen from the side too.
///   The shares of an eye that is closed on the neutral face are an arc, which it has when it opens.
///   The edges of the lids of a modelled eye are where they are seen from the front, with the shares that
///   `modelled_eye.h` gives.
/// - Fold of an upper lid: an arc between the corners through its point (3.13, 3.14), with the shares of the edge below
///   it. A fold is a line; if the point were held alone, a brow near to it that rises would leave a notch there. A
///   vertex below the arc follows the edge too, by as much as it is nearer to it: else it would stay behind the skin
///   beside it in a blink. Where no vertex is near the arc, as on coarse meshes, there is no place.
/// - Inner edge of a lip: linear interpolation from point to point, with the same shares for both lips, so that lips
///   that touch and move equally continue to touch. A vertex on the edges of both lips (a mouth that is a line of
///   single vertices, as on coarse heads) follows the mean of both, points at it included: if it followed the lip of
///   its point alone, the line would become a zigzag when the mouth opens.
///
/// Edges of lids are shortest paths between the points that bound them, before the eyeballs among `parts`, for lips see
/// lip_edge.h; an edge with a missing point has no places. A lid on a part without corners (a shell behind the fold)
/// ends at its vertices nearest to the corners. A fold far below its brow (4.3, 4.4) or on another part than its lid
/// has no places.
std::vector<MarginSite> margin_sites(const Surface& surface, std::span<const SurfacePoint> points,
                                     const ModelledEyes& modelled = {}, std::span<const Part> parts = {});

}  // namespace semblante

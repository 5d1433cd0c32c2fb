#pragma once

#include <span>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/tables/openings.h"

namespace semblante {

/// The opening whose upper or lower flesh a point belongs to, and which of the two; no opening for all other points
/// (corners belong to both sides).
struct RimOfPoint {
  const mpeg4::Opening* opening = nullptr;
  bool is_upper = false;
};
RimOfPoint rim_of_point(FeaturePointId id);

/// Tells the upper lip or lid from the lower one along the surface. Straight distance cannot: rims that touch, or pass
/// each other, are near to each other through the gap, while the surface leads round a corner or through the cavity
/// behind.
///
/// `anchors` are points whose vertices are beyond doubt. Those of the flesh and beside the opening count, whichever are
/// given: distance is compared after that from the anchors to the nearest corner is taken off, so that no side wins
/// because its anchors happen to be nearer.
class RimSides {
 public:
  RimSides(const Surface& surface, const mpeg4::Opening& opening, std::span<const SurfacePoint> anchors);

  /// Whether there are anchors on both sides. Without, every side is 0.
  [[nodiscard]] bool have_anchors() const { return !from_upper_.empty() && !from_lower_.empty(); }

  /// From 1 (upper) to -1 (lower): the detour from the anchors of the other side, as a share of the way to the nearest
  /// corner and back. 1 is a slit that is open to the depth; about 0 are the corners, a membrane or welded rims, and
  /// vertices that no path joins to any anchor.
  [[nodiscard]] double side(SurfaceVertexId vertex) const;
  /// The same with the sign of the side asked for: positive on that side.
  [[nodiscard]] double side(SurfaceVertexId vertex, bool is_upper) const {
    return is_upper ? side(vertex) : -side(vertex);
  }

  /// At this share and above the side is beyond doubt: rims joined within less than half of the way round the corner
  /// are what the doctor reports as joined.
  static constexpr double clear = 0.5;

 private:
  const Surface& surface_;
  std::vector<glm::dvec3> corners_;
  std::vector<double> upper_at_corner_, lower_at_corner_;  ///< distance of the anchors to each corner
  std::vector<double> from_upper_, from_lower_;            ///< #S; empty without anchors
};

}  // namespace semblante

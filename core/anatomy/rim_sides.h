#pragma once

#include <span>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/tables/openings.h"

namespace semblante {

/// Which lip or lid a feature point lies on: the opening (mouth or eye), and whether the point is on its upper or its
/// lower side. `opening` is null for all other points, among them the corners, which lie on both sides.
struct RimOfPoint {
  const mpeg4::Opening* opening = nullptr;
  bool is_upper = false;
};
RimOfPoint rim_of_point(FeaturePointId id);

/// Distinguishes the upper lip or lid from the lower one along the surface. The straight distance cannot: touching or
/// overlapping rims are close to each other across the gap, while the path on the surface goes around a corner or
/// through the cavity behind.
///
/// `anchors` are points whose vertices are certain. All those on the lips (or lids) and beside the opening are used.
/// The distance from the anchors to the nearest corner is subtracted before the comparison, so that no side has an
/// advantage because its anchors are nearer.
class RimSides {
 public:
  RimSides(const Surface& surface, const mpeg4::Opening& opening, std::span<const SurfacePoint> anchors);

  /// Whether both sides have anchors. Otherwise every side is 0.
  [[nodiscard]] bool have_anchors() const { return !from_upper_.empty() && !from_lower_.empty(); }

  /// From 1 (upper) to -1 (lower): the detour from the anchors of the other side, as a fraction of the path to the
  /// nearest corner and back. 1 is a slit open to its depth; about 0 are the corners, a membrane or welded rims, and
  /// vertices without a path to any anchor.
  [[nodiscard]] double side(SurfaceVertexId vertex) const;
  /// The same with the sign of the given side: positive on that side.
  [[nodiscard]] double side(SurfaceVertexId vertex, bool is_upper) const {
    return is_upper ? side(vertex) : -side(vertex);
  }

  /// From this value on the side is certain: the doctor reports rims as joined if the path between them is less than
  /// half of that around the corner.
  static constexpr double clear = 0.5;

 private:
  const Surface& surface_;
  std::vector<glm::dvec3> corners_;
  std::vector<double> upper_at_corner_, lower_at_corner_;  ///< distance of the anchors to each corner
  std::vector<double> from_upper_, from_lower_;            ///< #S; empty without anchors
};

}  // namespace semblante

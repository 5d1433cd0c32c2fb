#pragma once

#include <span>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/tables/openings.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// A point of an eye's lids that lies on the eye itself, which is modelled in the skin.
struct PointOnEye {
  SurfacePoint point;
  const mpeg4::Opening* lids;
  SurfaceVertexId edge;  ///< where the point belongs: on the edge of its lid, or where both lids meet
};

/// The points that keep lids from closing over an eye that is modelled in the skin, because they lie on it. Empty of an
/// eye over which the lids close as they are (`find_modelled_eyes`), or over which they would not close either if all
/// these points were on the edges: no other move is believed. `triangles` are of file vertices; the head is upright.
std::vector<PointOnEye> find_points_on_eyes(const Surface& surface, std::span<const Triangle> triangles,
                                            std::span<const Part> parts, std::span<const SurfacePoint> points);

}  // namespace semblante

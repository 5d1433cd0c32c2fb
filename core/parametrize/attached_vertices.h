#pragma once

#include <span>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/types/rig.h"

namespace semblante {

/// A vertex of the skin that a vertex of an attached part follows, and by which share.
struct FollowedVertex {
  SurfaceVertexId vertex;
  double share = 1.0;
};

/// What the vertices of attached parts follow, by surface vertex; empty for other vertices and without skin. The shares
/// of a vertex have the sum 1.
///
/// A lash is attached to the lid by its root: its tip must not follow the brow, which may be nearer. So a vertex
/// follows the skin vertex with the shortest path to it, where lengths through the air count several times those along
/// the part. The paths of lashes end at the edge of their lid: on a face with heavy lids or a low brow, their tips lie
/// on the skin above it. Beyond its root a lash follows a mean along the edge, or it would crumple where the edge
/// moves unequally, as at the corners of the eye. On an eye that is closed, the lashes of both lids are told apart by
/// which of them is nearer to the upper edge.
std::vector<std::vector<FollowedVertex>> followed_by_attached(const Surface& surface, std::span<const Part> parts,
                                                              std::span<const SurfacePoint> points);

}  // namespace semblante

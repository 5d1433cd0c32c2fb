#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/types/rig.h"

namespace semblante {

/// The skin vertex that a vertex of an attached part follows, by surface vertex; empty for other vertices and without
/// skin.
///
/// A lash is attached to the lid by its root: its tip must not follow the brow, which may be nearer. So a vertex
/// follows the skin vertex with the shortest path to it, where lengths through the air count several times those along
/// the part. The paths of lashes end at the edge of their lid: on a face with heavy lids or a low brow, their tips lie
/// on the skin above it.
std::vector<std::optional<SurfaceVertexId>> followed_by_attached(const Surface& surface, std::span<const Part> parts,
                                                                 std::span<const SurfacePoint> points);

}  // namespace semblante

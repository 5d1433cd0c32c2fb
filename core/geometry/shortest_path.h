#pragma once

#include <vector>

#include "core/geometry/surface.h"

namespace semblante {

/// The vertices of a shortest path along edges, including both ends; empty if there is no path. The search ends at
/// `to`, so it is fast for nearby ends.
std::vector<SurfaceVertexId> shortest_path(const Surface& surface, SurfaceVertexId from, SurfaceVertexId to);

}  // namespace semblante

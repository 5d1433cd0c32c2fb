#pragma once

#include <vector>

#include "core/geometry/surface.h"

namespace semblante {

/// The vertices of a shortest path along edges, both ends included; empty where no edges lead from one to the other.
/// Looks no farther than it must: meant for ends that are near to each other.
std::vector<SurfaceVertexId> shortest_path(const Surface& surface, SurfaceVertexId from, SurfaceVertexId to);

}  // namespace semblante

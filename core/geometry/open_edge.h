#pragma once

#include "core/geometry/surface.h"

namespace semblante {

/// Whether fewer than two triangles have the edge: both ends of it are joined to their third vertices.
bool is_open_edge(const Surface& surface, SurfaceVertexId a, SurfaceVertexId b);

}  // namespace semblante

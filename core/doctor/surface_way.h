#pragma once

#include <span>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"

namespace semblante {

/// The vertices of a shortest path along mesh edges, from `to` back to a source, where `distances` (of
/// EdgePathSearch) are zero.
std::vector<SurfaceVertexId> way_back(const Surface& surface, std::span<const double> distances, SurfaceVertexId to);

}  // namespace semblante

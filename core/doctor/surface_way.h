#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"

namespace semblante {

/// The point with this name ("2.1"), or null. `name` must be one of the 84.
const SurfacePoint* point_named(std::span<const SurfacePoint> points, std::string_view name);

/// The vertices of a shortest path along mesh edges, from `to` back to a source, where `distances` (of
/// EdgePathSearch) are zero.
std::vector<SurfaceVertexId> way_back(const Surface& surface, std::span<const double> distances, SurfaceVertexId to);

}  // namespace semblante

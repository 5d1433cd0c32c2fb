#pragma once

#include <functional>
#include <vector>

#include "core/geometry/surface.h"

namespace semblante {

/// How many times as long as it is a step to a vertex counts; 1 or more.
using StepCost = std::function<double(SurfaceVertexId)>;

/// The vertices of a shortest path along edges, including both ends; empty if there is no path. The search ends at
/// `to`, so it is fast for nearby ends. Without `cost` every step counts once.
std::vector<SurfaceVertexId> shortest_path(const Surface& surface, SurfaceVertexId from, SurfaceVertexId to,
                                           const StepCost& cost = {});

}  // namespace semblante

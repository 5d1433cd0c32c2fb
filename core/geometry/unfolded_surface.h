#pragma once

#include <span>

#include "core/geometry/surface.h"

namespace semblante {

/// The graph of the metric `unfolded`: `surface` with shortcuts. Two triangles that share an edge, unfolded to a plane,
/// have a diagonal between their far corners. If it crosses the shared edge, it is a path on the surface, shorter than
/// any along edges. Shortest paths are then straighter than along edges only, and every length is still that of a path
/// on the surface: never below the true geodesic distance.
///
/// `triangles` are the model's, by file vertex. Need not be manifold: every pair of triangles at an edge is unfolded.
Surface with_unfolded_diagonals(const Surface& surface, std::span<const Triangle> triangles);

}  // namespace semblante

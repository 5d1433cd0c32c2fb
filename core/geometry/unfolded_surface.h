#pragma once

#include <span>

#include "core/geometry/surface.h"

namespace semblante {

/// The graph of the metric `unfolded`: `surface` with shortcuts. Two triangles that share an edge, laid flat, have a
/// diagonal from one far corner to the other; where it crosses the shared edge it is a way along the surface, and
/// shorter than any along edges. So shortest paths turn less often than along edges alone, and every length is still
/// that of a real path: never below the true geodesic distance.
///
/// `triangles` are the model's, by file vertex. Needs no manifold: every pair of triangles at an edge is laid flat.
Surface with_unfolded_diagonals(const Surface& surface, std::span<const Triangle> triangles);

}  // namespace semblante

#pragma once

#include <functional>

#include "deploy/sample_head/half_mesh.h"

namespace semblante::sample_head_detail {

/// One Catmull-Clark step of the half mesh. Edges on the mirror plane behave as if the other half were there; other
/// boundary edges follow the cubic B-spline rule. Old vertices keep their numbers.
HalfMesh subdivide(const HalfMesh& mesh);

/// Splits into four the quads whose centre `where` accepts; their neighbours become fans of triangles about a centre of
/// their own. New vertices are at the middles of edges and at centres; the caller projects them onto the surface.
HalfMesh refine(const HalfMesh& mesh, const std::function<bool(const Vec3& centre)>& where);

/// The boundary loop from `start`, first to its boundary neighbour farthest along `towards`, and then on until it
/// returns to `start` or meets the mirror plane.
Loop boundary_loop(const HalfMesh& mesh, int start, const Vec3& towards);

}  // namespace semblante::sample_head_detail

#pragma once

#include <span>

#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante {

/// Whether two lists of triangles may be of one mesh whose vertices are numbered alike: at least half of the edges of
/// `expression` are edges of `neutral`. All would be too much to ask, since programs split the same quads along either
/// diagonal; vertices in another order share next to none. An expression without triangles says nothing against it.
/// Error: `mismatch`, where "/expression".
Status check_same_mesh(std::span<const Triangle> neutral, std::span<const Triangle> expression);

}  // namespace semblante

#pragma once

#include <span>

#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante {

/// Checks that two lists of triangles may belong to one mesh with equal vertex numbers: at least half of the edges of
/// `expression` are edges of `neutral`. Not all, because programs split quads along either diagonal; with another
/// vertex order almost no edges are equal. An expression without triangles passes.
/// Error: `mismatch`, where "/expression".
Status check_same_mesh(std::span<const Triangle> neutral, std::span<const Triangle> expression);

}  // namespace semblante

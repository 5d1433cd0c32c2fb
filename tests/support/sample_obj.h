#pragma once

#include <string>

#include "deploy/sample_head/sample_head.h"

namespace semblante::testing {

/// A head as OBJ: a group for each part, a vertex for each place of a part (so without the seams of the GLB), the
/// triangles in the order and corner for corner as in the GLB.
std::string obj_of(const SampleHead& head);

}  // namespace semblante::testing

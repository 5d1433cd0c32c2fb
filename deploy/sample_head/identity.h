#pragma once

#include "deploy/sample_head/sample_head.h"

namespace semblante::sample_head_detail {

/// Reshapes a finished part into the face of another person: the widths and lengths of `traits`. Topology, UVs and the
/// symmetry stay; the eyeballs hardly move.
void reshape(SampleHeadMesh& mesh, const SampleHeadTraits& traits);

}  // namespace semblante::sample_head_detail

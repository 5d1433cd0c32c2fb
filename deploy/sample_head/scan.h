#pragma once

#include "deploy/sample_head/sample_head.h"

namespace semblante::sample_head_detail {

/// The outside of a head as one surface of about 30,000 vertices, as a 3D scanner records it: lips and lids are joined,
/// mouth and eyes have no inside, ears are filled behind, vertices and diagonals are irregular, the person is slightly
/// asymmetric, and there is no texture. Points of teeth and tongue are omitted; pupils are positions without a vertex.
SampleHead scan_of(const SampleHead& head);

}  // namespace semblante::sample_head_detail

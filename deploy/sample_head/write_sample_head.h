#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/types/result.h"
#include "deploy/sample_head/sample_head.h"

namespace semblante {

/// The head as a binary glTF: a node and a mesh of one primitive per SampleHeadMesh, in order, with textures as PNG.
Result<std::vector<std::uint8_t>> sample_head_glb(const SampleHead& head);

/// The feature points of the head as JSON: {"points": {"2.1": {"vertex": n, "position": [x, y, z]}, ...}}, `vertex`
/// counted over the GLB's primitives in order and null for a bare position.
std::string sample_head_feature_points_json(const SampleHead& head);

}  // namespace semblante

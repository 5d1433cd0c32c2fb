#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/import/gltf_document.h"

namespace semblante::import {

/// world(joint) * inverse bind matrix of each joint of a skin, in the pose the nodes have in the file: what stands in
/// for the node's own transform, which glTF ignores for a skinned mesh. `world` is by node; nodes outside the scene
/// have none. Empty when a joint is one of those. Faults are kept in the document.
std::vector<glm::dmat4> joint_matrices(GltfDocument& document, std::size_t skin,
                                       std::span<const std::optional<glm::dmat4>> world);

/// The one matrix that all of these are, up to float32 rounding, exactly the identity if it is that; nullopt if they
/// differ. Most heads are saved in their bind pose, where a skin moves nothing.
std::optional<glm::dmat4> common_matrix(std::span<const glm::dmat4> matrices);

}  // namespace semblante::import

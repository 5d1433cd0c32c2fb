#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/import/gltf_document.h"

namespace semblante::import {

/// world(joint) * inverse bind matrix of each joint of a skin, in the pose of the file's nodes; replaces the node's
/// transform, which glTF ignores for a skinned mesh. `world` is by node, empty for nodes outside the scene. The result
/// is empty if a joint is outside the scene. Errors are kept in the document.
std::vector<glm::dmat4> joint_matrices(GltfDocument& document, std::size_t skin,
                                       std::span<const std::optional<glm::dmat4>> world);

/// Equal up to float32 rounding.
bool nearly_equal(const glm::dmat4& a, const glm::dmat4& b);

/// The matrix if all are equal up to float32 rounding (exactly the identity if close to it); nullopt if they differ.
/// Most heads are saved in their bind pose, in which a skin has no effect.
std::optional<glm::dmat4> common_matrix(std::span<const glm::dmat4> matrices);

}  // namespace semblante::import

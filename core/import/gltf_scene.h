#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/import/gltf_document.h"

namespace semblante::import {

/// The transform of a mesh: that of its first node, depth first in the scene's order.
struct MeshPlacement {
  glm::dmat4 to_world{1.0};
  bool is_identity = true;
  std::size_t node_count = 1;  ///< nodes that show it
  std::optional<std::size_t> skin;
  /// For a skin that is not in its bind pose: the joints place each vertex, and to_world is not used. Shared by all
  /// meshes of the skin; null for others.
  std::shared_ptr<const std::vector<glm::dmat4>> joints;
};

struct GltfScene {
  std::vector<std::optional<MeshPlacement>> meshes;  ///< per mesh of the document; nullopt if it is not in the scene
  std::vector<std::optional<glm::dmat4>> world;      ///< per node: its transform; nullopt if it is not in the scene
};

/// A document without nodes has all meshes untransformed. Errors (loops, indices out of range, numbers) are kept in the
/// document.
GltfScene read_scene(GltfDocument& document);

}  // namespace semblante::import

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/import/gltf_document.h"

namespace semblante::import {

/// Where a mesh stands: the first node, depth first in the scene's order, that shows it.
struct MeshPlacement {
  glm::dmat4 to_world{1.0};
  bool is_identity = true;
  std::size_t node_count = 1;  ///< nodes that show it
  std::optional<std::size_t> skin;
  /// Of a skin whose pose is not its bind pose: each vertex stands where its joints put it, and to_world says nothing.
  /// Shared by all meshes of the skin; null for others.
  std::shared_ptr<const std::vector<glm::dmat4>> joints;
};

/// Per mesh of the document; nullopt for a mesh the scene does not show. A document without nodes shows all of them as
/// they are. Faults (loops, indices out of range, numbers) are kept in the document.
std::vector<std::optional<MeshPlacement>> place_meshes(GltfDocument& document);

}  // namespace semblante::import

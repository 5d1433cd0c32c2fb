#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/import/gltf_document.h"

namespace semblante::import {

/// Where a node puts a mesh.
struct MeshPlacement {
  glm::dmat4 to_world{1.0};
  bool is_identity = true;
  std::optional<std::size_t> skin;
  /// For a skin that is not in its bind pose: the joints place each vertex, and to_world is not used. Shared by all
  /// meshes of the skin; null for others.
  std::shared_ptr<const std::vector<glm::dmat4>> joints;
};

/// The places of one mesh, such as the eye that a left and a right node show: depth first in the scene's order, each
/// place once, and empty if the mesh is not in the scene.
struct MeshPlacements {
  /// A head has a few of anything. Bounds the work for a file whose nodes all show one mesh, and with it Draco's (see
  /// GltfDocument::draco_view).
  static constexpr std::size_t most = 8;

  std::vector<MeshPlacement> kept;
  std::size_t count = 0;  ///< with those beyond `most`
};

struct GltfScene {
  std::vector<MeshPlacements> meshes;            ///< per mesh of the document
  std::vector<std::optional<glm::dmat4>> world;  ///< per node: its transform; nullopt if it is not in the scene
};

/// A document without nodes has all meshes untransformed. Errors (loops, indices out of range, numbers) are kept in the
/// document.
GltfScene read_scene(GltfDocument& document);

}  // namespace semblante::import

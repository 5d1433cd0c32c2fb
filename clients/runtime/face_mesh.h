#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/types/model.h"
#include "core/types/result.h"
#include "protocol/cpp/rig_document.h"

namespace semblante::runtime {

/// The decoded mesh.drc. The rows of the weight table are in the order of its vertices.
struct FaceMesh {
  std::vector<glm::vec3> positions;     ///< #V
  std::vector<glm::vec3> normals;       ///< #V or empty
  std::vector<glm::vec2> uvs;           ///< #V or empty
  std::vector<std::uint8_t> colors;     ///< #V by 3, or empty
  std::vector<std::uint8_t> materials;  ///< #V or empty: index into rig.json's materials
  std::vector<Triangle> triangles;      ///< #T, all indices < #V
};

/// Decodes any bytes: refuses all but a triangle mesh with the counts and positions stated in `mesh`. Missing
/// normals, UVs and materials, or ones that do not match it, are omitted. `unsupported` in builds without Draco.
Result<FaceMesh> decode_mesh(std::span<const std::uint8_t> bytes, const RigDocument::Mesh& mesh);

}  // namespace semblante::runtime

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/types/model.h"
#include "core/types/result.h"
#include "protocol/cpp/rig_document.h"

namespace semblante::client {

/// mesh.drc, decoded: what the weight table counts its rows by.
struct DecodedMesh {
  std::vector<glm::vec3> positions;     ///< #V
  std::vector<glm::vec2> uvs;           ///< #V or empty
  std::vector<std::uint8_t> materials;  ///< #V or empty: index into rig.json's materials
  std::vector<Triangle> triangles;      ///< #T, all indices < #V
};

/// Decodes any bytes: refuses what is not a triangle mesh with the counts and attributes that `mesh` announces,
/// positions that are not finite, and indices out of range (Draco itself has no checksum).
Result<DecodedMesh> decode_mesh(std::span<const std::uint8_t> bytes, const RigDocument::Mesh& mesh);

}  // namespace semblante::client

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/types/result.h"
#include "protocol/package/render_mesh.h"

namespace semblante {

/// The Draco unique ids of the attributes of mesh.drc. Stated in rig.json.
struct MeshAttributeIds {
  std::uint32_t position = 0;
  std::uint32_t normal = 1;
  std::optional<std::uint32_t> uv;
  std::uint32_t material = 0;
  std::optional<std::uint32_t> color;
};

/// mesh.drc and the order of its decoded vertices, which weights and rig.json use.
struct EncodedMesh {
  std::vector<std::uint8_t> bytes;
  MeshAttributeIds attributes;
  std::vector<std::uint32_t> file_vertex;  ///< #D, the model file's vertex of each decoded vertex
  std::size_t triangle_count = 0;
};

/// Encodes `mesh` by edgebreaker (which renumbers, splits and drops vertices), decodes it back and checks that every
/// triangle with three different corners survived and no position moved by more than a quantum.
///
/// The map from decoded to file vertices comes from a trial encoding that carries vertex numbers as an attribute. They
/// are not in the final file: on a head whose file order differs much from Draco's they take a fifth of mesh.drc (26 of
/// 146 kB on 26.7k vertices), and no client needs them. The function checks that both encodings decode to the same
/// order.
Result<EncodedMesh> encode_mesh(const RenderMesh& mesh);

}  // namespace semblante

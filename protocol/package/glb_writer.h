#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/types/model.h"
#include "core/types/result.h"
#include "core/types/weight_table.h"
#include "protocol/package/render_mesh.h"

namespace semblante {

/// The data of face.glb besides the mesh: rows per render vertex and the rig document.
struct GlbFace {
  const WeightTable<float>* rows = nullptr;  ///< #R rows, normalized quotients of Eq. 7
  std::span<const std::uint8_t> rigid;       ///< #R, RigidMotion values
  std::span<const std::uint8_t> turn;        ///< #R, 255ths of the head's rotation; empty: all vertices turn fully
  std::string rig_json;                      ///< content of the SEMBLANTE_face extension
};

/// A glTF 2.0 binary with one KHR_draco_mesh_compression primitive per material, attributes _FP_INDEX_n / _FP_WEIGHT_n
/// (four influences each), _RIGID and, if not all vertices turn fully with the head, _TURN, materials and textures
/// kept, the rig in the extension SEMBLANTE_face of the scene.
Result<std::vector<std::uint8_t>> write_face_glb(const RenderMesh& mesh, const std::vector<Material>& materials,
                                                 const std::vector<Image>& images, const GlbFace& face);

/// The neutral model for display in the studio: uncompressed, one primitive per material, FLOAT attribute _FILE_VERTEX
/// is the model file's vertex number (exact below 2^24, which is more than an import accepts), FLOAT attribute _PART
/// the number of its part. `part_of` (#R) holds PartId values.
Result<std::vector<std::uint8_t>> write_preview_glb(const RenderMesh& mesh, const std::vector<Material>& materials,
                                                    const std::vector<Image>& images,
                                                    std::span<const std::uint32_t> part_of);

}  // namespace semblante

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/types/model.h"
#include "core/types/result.h"
#include "protocol/cpp/rig_document.h"
#include "protocol/cpp/weights_format.h"
#include "protocol/package/render_mesh.h"

namespace semblante {

/// A stored face package: bytes by name, images by hash.
struct FaceParts {
  std::span<const std::uint8_t> mesh_drc;
  std::span<const std::uint8_t> weights;
  std::string_view rig_json;
  /// The bytes of an image named by rig.json. Not called, and may be empty, if it names none.
  std::function<Result<std::vector<std::uint8_t>>(const Sha256&)> image;
};

/// A decoded face package: the data of a client before the first frame. Vertices are those of mesh.drc.
struct PackedFace {
  RenderMesh mesh;  ///< file_vertex is empty: a package does not contain it
  InfluenceTable table;
  RigDocument rig;
  std::vector<Material> materials;  ///< at least one
  std::vector<Image> images;
};

/// Opens a package and checks that its parts belong together, by hash and by count.
Result<PackedFace> open_package(const FaceParts& parts);

}  // namespace semblante

#pragma once

#include <vector>

#include <glm/mat3x3.hpp>

#include "core/import/gltf_document.h"
#include "core/import/model_builder.h"

namespace semblante::import {

/// How a material takes its texture coordinates from a primitive.
struct UvSource {
  std::size_t set = 0;        ///< n of TEXCOORD_n
  glm::dmat3 transform{1.0};  ///< KHR_texture_transform of the base colour
  bool is_identity = true;
};

/// Reads all materials, and the images they use, into the model; gives the UV source of each material. Images stay the
/// file's own bytes. What cannot be shown (another image format) becomes a warning.
std::vector<UvSource> read_materials(GltfDocument& document, ModelBuilder& builder);

}  // namespace semblante::import

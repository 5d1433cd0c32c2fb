#pragma once

#include <vector>

#include <glm/mat3x3.hpp>

#include "core/import/gltf_document.h"
#include "core/import/model_builder.h"

namespace semblante::import {

/// The texture coordinate set of a primitive that a material uses.
struct UvSource {
  std::size_t set = 0;        ///< n of TEXCOORD_n
  glm::dmat3 transform{1.0};  ///< KHR_texture_transform of the base colour
  bool is_identity = true;
};

/// Reads all materials and their images into the model; returns the UV source of each material. Images that
/// cannot be read become a warning.
std::vector<UvSource> read_materials(GltfDocument& document, ModelBuilder& builder);

}  // namespace semblante::import

#pragma once

#include <vector>

#include "core/types/model.h"
#include "protocol/cpp/rig_document.h"

namespace semblante {

/// Converts a material of rig.json to that of a Model: an image is an index into `images`, -1 if none has its hash.
Material material_of(const RigDocument::MaterialInfo& info, const std::vector<RigDocument::ImageInfo>& images);

}  // namespace semblante

#pragma once

#include <vector>

#include "core/types/model.h"
#include "protocol/cpp/rig_document.h"

namespace semblante {

/// A material of rig.json as a Model has it: images by their place in `images`, -1 where none has the hash.
Material material_of(const RigDocument::MaterialInfo& info, const std::vector<RigDocument::ImageInfo>& images);

}  // namespace semblante

#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/import/import.h"
#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante {

/// The positions (#V, file vertices) of a model with one of its morph targets at full strength; the neutral ones for
/// "". Error: `missing`, with the list of the existing names (`where` is empty).
Result<std::vector<glm::vec3>> shape_of_target(const Model& model, std::string_view target);

/// The positions of another file of the same mesh, in that file's own frame. Files with only vertices (OBJ with `v`
/// lines only, PLY without faces) are accepted. Errors: those of import_model; `mismatch` at "/expression" if its
/// faces, if any, differ from those of `neutral` (same_mesh.h), or its number of vertices.
Result<std::vector<glm::vec3>> shape_of_file(const Model& neutral, std::span<const std::uint8_t> bytes,
                                             std::string_view file_name);

}  // namespace semblante

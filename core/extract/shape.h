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

/// The positions (#V, file vertices) of a model with one of its morph targets on in full; the neutral ones for "".
/// Error `missing`, which lists the names there are (where is left empty).
Result<std::vector<glm::vec3>> shape_of_target(const Model& model, std::string_view target);

/// The positions of another file of the same mesh, in that file's own frame. Files of vertices alone (OBJ with `v`
/// lines only, PLY without faces) are taken too. Errors: those of import_model; `mismatch` when its faces, if it has
/// any, are not those of `neutral` (same_mesh.h) or its vertices are fewer or more; where is "/expression" for these.
Result<std::vector<glm::vec3>> shape_of_file(const Model& neutral, std::span<const std::uint8_t> bytes,
                                             std::string_view file_name);

}  // namespace semblante

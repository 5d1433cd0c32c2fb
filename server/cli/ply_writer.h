#pragma once

#include <iosfwd>
#include <span>

#include <glm/vec3.hpp>

#include "core/types/model.h"

namespace semblante {

/// Binary little-endian PLY of the triangles of `model` with other positions (#V, MPEG-4 frame), file vertices in their
/// order, back in the file's axes and unit. Smaller and faster than OBJ; with colours, without uvs and groups.
void write_ply(const Model& model, std::span<const glm::vec3> positions, std::ostream& out);

}  // namespace semblante

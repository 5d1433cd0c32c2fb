#pragma once

#include <iosfwd>
#include <span>

#include <glm/vec3.hpp>

#include "core/types/model.h"

namespace semblante {

/// Writes the triangles, uvs, groups and material names of `model` with other positions (#V, MPEG-4 frame): `v` lines
/// in file vertex order, back in the file's axes and unit, each the shortest that reads back as the same float32.
/// Normals are omitted: they are those of the neutral face.
void write_obj(const Model& model, std::span<const glm::vec3> positions, std::ostream& out);

}  // namespace semblante

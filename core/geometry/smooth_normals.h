#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "core/geometry/surface.h"
#include "core/types/model.h"

namespace semblante {

/// One unit normal a surface vertex (#S): area-weighted means over the stitched surface, so that UV seams do not show;
/// +Z where no triangle has an area. These are the normals a file lacks. Those of a face that moves are
/// `semblante_normals`.
std::vector<glm::vec3> smooth_normals(const Model& model, const Surface& surface);

}  // namespace semblante

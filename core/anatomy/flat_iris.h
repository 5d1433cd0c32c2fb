#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "core/geometry/surface.h"
#include "core/types/model.h"

namespace semblante {

/// The centre of the flat regular polygon with the corner `marked` at the front of an eye that looks along `axis`;
/// nullopt if there is none.
std::optional<glm::dvec3> middle_of_flat_iris(const Model& model, const Surface& surface, SurfaceVertexId marked,
                                              const glm::dvec3& axis);

}  // namespace semblante

#pragma once

#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// The centre of a pupil that is a round hole in a part with `role`; nullopt if there is none. In model units.
///
/// The rim of the hole is a ring of edges inside the iris of `iris_radius`, at which triangles that face along `axis`
/// end: at nothing, or at the wall of an eye of some thickness. The front lies outside the ring; a disc (a highlight)
/// is inside its own. `axis` is a unit vector from `pivot` through the marked pupil, whose distance from the centre may
/// be up to half of `iris_radius`. Of several rings, the one nearest to the axis is the result.
std::optional<glm::dvec3> middle_of_pupil_hole(const Model& model, const Surface& surface, std::span<const Part> parts,
                                               PartRole role, const glm::dvec3& pivot, const glm::dvec3& axis,
                                               double iris_radius);

}  // namespace semblante

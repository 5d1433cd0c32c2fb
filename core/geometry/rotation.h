#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace semblante {

/// The smallest rotation that turns the unit vector `from` into the unit vector `to`. They must not be opposite.
glm::dmat3 rotation_between(const glm::dvec3& from, const glm::dvec3& to);

/// The angle of a rotation, degrees.
double degrees_of(const glm::dmat3& rotation);

}  // namespace semblante

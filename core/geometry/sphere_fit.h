#pragma once

#include <optional>
#include <span>

#include <glm/vec3.hpp>

namespace semblante {

struct Sphere {
  glm::dvec3 center{0.0};
  double radius = 0.0;
  double rms_error = 0.0;  ///< root mean square of the points' distances to the sphere
};

/// The sphere that fits `points` best (least squares of |p|^2 - 2 c.p + (|c|^2 - r^2)); empty for fewer than four
/// points and for points too close to a plane.
std::optional<Sphere> fit_sphere(std::span<const glm::dvec3> points);

}  // namespace semblante

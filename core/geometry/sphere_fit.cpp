#include "core/geometry/sphere_fit.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace semblante {

std::optional<Sphere> fit_sphere(std::span<const glm::dvec3> points) {
  if (points.size() < 4) return std::nullopt;
  const double count = static_cast<double>(points.size());
  glm::dvec3 mean{0.0};
  for (const glm::dvec3& p : points) mean += p;
  mean /= count;

  // With q = p - mean the constant term drops out: 2 (sum q q^T) c = sum |q|^2 q.
  glm::dmat3 spread{0.0};
  glm::dvec3 pull{0.0};
  double size = 0.0;
  for (const glm::dvec3& p : points) {
    const glm::dvec3 q = p - mean;
    spread += glm::outerProduct(q, q);
    pull += glm::dot(q, q) * q;
    size += glm::dot(q, q);
  }
  // The determinant is the product of the variances along three axes; near 0 relative to their cubed mean: a flat
  // patch.
  constexpr double flat = 1e-6;
  const double scale = size / 3.0;
  if (!(scale > 0.0) || glm::determinant(spread) < flat * scale * scale * scale) return std::nullopt;
  const glm::dvec3 offset = 0.5 * (glm::inverse(spread) * pull);

  Sphere sphere;
  sphere.center = mean + offset;
  sphere.radius = std::sqrt(size / count + glm::dot(offset, offset));
  double squares = 0.0;
  for (const glm::dvec3& p : points) {
    const double error = glm::distance(p, sphere.center) - sphere.radius;
    squares += error * error;
  }
  sphere.rms_error = std::sqrt(squares / count);
  return sphere;
}

}  // namespace semblante

#include "core/lod/importance.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/anatomy/part_roles.h"

namespace semblante {
namespace {

/// The price of a collapse is an area times a squared distance, so at equal prices the density of vertices on a curved
/// surface goes with the cube root of the factor: the densities relative to skin are 0.6, 0.4, 0.2 and 0.15.
double factor_of_role(PartRole role) {
  switch (role) {
    case PartRole::skin:
      return 1.0;
    case PartRole::left_eye:
    case PartRole::right_eye:
      return 0.06;
    case PartRole::tongue:
      return 0.008;
    case PartRole::upper_teeth:
    case PartRole::lower_teeth:
      return 0.0034;
    default:
      return 0.2;
  }
}

/// The sphere about the points of the face, without 7.1 and the ears' and the hair's, which lie around it.
struct FaceSphere {
  glm::dvec3 center{0.0};
  double radius = 0.0;  ///< 0: there are no points
};

FaceSphere face_sphere(const Rig& rig) {
  FaceSphere sphere;
  double count = 0.0;
  const auto is_of_face = [](const FeaturePoint& p) { return is_skin_point(p.id) && group_of(p.id) != 10; };
  for (const FeaturePoint& point : rig.points) {
    if (!is_of_face(point)) continue;
    sphere.center += glm::dvec3(point.position);
    count += 1.0;
  }
  if (count == 0.0) return sphere;
  sphere.center /= count;
  for (const FeaturePoint& point : rig.points) {
    if (is_of_face(point)) {
      sphere.radius = std::max(sphere.radius, glm::distance(glm::dvec3(point.position), sphere.center));
    }
  }
  return sphere;
}

}  // namespace

std::vector<double> importance_of_vertices(const Surface& surface, const Rig& rig) {
  // A face is wider than its points, which end at the brows and the jaw.
  constexpr double margin = 1.15;
  // The feet of a tall body must keep a shape.
  constexpr double least = 1e-5;
  const FaceSphere face = face_sphere(rig);
  const double reach = margin * face.radius;
  std::vector<double> factors(surface.vertex_count(), 1.0);
  for (std::size_t s = 0; s < factors.size(); ++s) {
    const double role = factor_of_role(rig.parts[surface.part_of[s].value()].role);
    const double away = glm::distance(surface.positions[s], face.center);
    const double near = reach > 0.0 && away > reach ? std::pow(reach / away, 4.0) : 1.0;
    factors[s] = std::max(role * near, least);
  }
  return factors;
}

}  // namespace semblante

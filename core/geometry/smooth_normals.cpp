#include "core/geometry/smooth_normals.h"

#include <glm/geometric.hpp>

#include "core/geometry/triangle_shape.h"

namespace semblante {

std::vector<glm::vec3> smooth_normals(const Model& model, const Surface& surface) {
  std::vector<glm::dvec3> sums(surface.vertex_count(), glm::dvec3(0.0));
  for (const Triangle& t : model.triangles) {
    const glm::dvec3 area = area_vector(model.positions[t[0]], model.positions[t[1]], model.positions[t[2]]);
    for (const std::uint32_t corner : t) sums[surface.surface_of[corner].value()] += area;
  }
  std::vector<glm::vec3> normals;
  normals.reserve(sums.size());
  for (const glm::dvec3& sum : sums) {
    const double length = glm::length(sum);
    normals.emplace_back(length > 0.0 ? sum / length : glm::dvec3(0.0, 0.0, 1.0));
  }
  return normals;
}

}  // namespace semblante

#include "core/geometry/enclosed_volume.h"

#include <array>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

namespace semblante {

std::vector<double> enclosed_volumes(const Model& model, const Surface& surface) {
  std::vector<glm::dvec3> middle(surface.part_count());
  for (std::uint32_t p = 0; p < surface.part_count(); ++p) {
    const auto members = surface.members_of(PartId(p));
    for (const SurfaceVertexId v : members)
      middle[p] += surface.positions[v.value()] / static_cast<double>(members.size());
  }
  std::vector<double> volume(surface.part_count(), 0.0);
  std::vector<double> size(surface.part_count(), 0.0);
  for (const Triangle& triangle : model.triangles) {
    const std::uint32_t part = surface.part_of[surface.surface_of[triangle[0]].value()].value();
    std::array<glm::dvec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = surface.positions[surface.surface_of[triangle[k]].value()] - middle[part];
    const double piece = glm::dot(p[0], glm::cross(p[1], p[2]));
    volume[part] += piece;
    size[part] += std::abs(piece);
  }
  for (std::size_t p = 0; p < volume.size(); ++p) volume[p] = size[p] > 0.0 ? volume[p] / size[p] : 0.0;
  return volume;
}

PartId largest_part(const Surface& surface) {
  assert(surface.part_count() > 0);
  std::uint32_t largest = 0;
  for (std::uint32_t p = 1; p < surface.part_count(); ++p)
    if (surface.members_of(PartId(p)).size() > surface.members_of(PartId(largest)).size()) largest = p;
  return PartId(largest);
}

}  // namespace semblante

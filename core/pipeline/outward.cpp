#include "core/pipeline/outward.h"

#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/geometry/enclosed_volume.h"
#include "core/geometry/triangle_shape.h"

namespace semblante {
namespace {

/// Most heads are not inside out: their whole volume shows it without a surface.
bool may_be_inside_out(const Model& model) {
  glm::dvec3 middle(0.0);
  for (const glm::vec3& p : model.positions) middle += glm::dvec3(p) / static_cast<double>(model.positions.size());
  double volume = 0.0;
  for (const Triangle& t : model.triangles) {
    const auto at = [&](std::size_t k) { return glm::dvec3(model.positions[t[k]]) - middle; };
    volume += glm::dot(at(0), glm::cross(at(1), at(2)));
  }
  return volume < 0.0;
}

bool is_inside_out(const Model& model) {
  const Surface surface = build_surface(model);
  if (surface.part_count() == 0) return false;
  const std::vector<double> volumes = enclosed_volumes(model, surface);
  const PartId largest = largest_part(surface);
  if (volumes[largest.value()] > inside_out_share) return false;
  const std::size_t of_some_size = surface.members_of(largest).size() / 100;
  for (std::uint32_t p = 0; p < surface.part_count(); ++p) {
    if (surface.members_of(PartId(p)).size() > of_some_size && volumes[p] > -inside_out_share) return false;
  }
  return true;
}

/// Normals are against the winding if most of the area says so.
bool normals_point_inwards(const Model& model) {
  double agreement = 0.0;
  for (std::size_t t = 0; t < model.normal_triangles.size(); ++t) {
    const Triangle& p = model.triangles[t];
    const glm::dvec3 area = area_vector(model.positions[p[0]], model.positions[p[1]], model.positions[p[2]]);
    for (const std::uint32_t normal : model.normal_triangles[t]) {
      if (normal != Model::no_index) agreement += glm::dot(area, glm::dvec3(model.normals[normal]));
    }
  }
  return agreement < 0.0;
}

}  // namespace

bool turn_outward(Model& model) {
  if (!may_be_inside_out(model) || !is_inside_out(model)) return false;
  for (auto* const triangles : {&model.triangles, &model.uv_triangles, &model.normal_triangles}) {
    for (Triangle& triangle : *triangles) std::swap(triangle[1], triangle[2]);
  }
  if (normals_point_inwards(model)) {
    for (glm::vec3& normal : model.normals) normal = -normal;
  }
  return true;
}

}  // namespace semblante

#include "core/lod/level_normals.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "core/geometry/smooth_normals.h"
#include "core/geometry/triangle_shape.h"

namespace semblante {
namespace {

/// Cosine of the angle to the mean (37 degrees) from which a normal is replaced.
constexpr double alone = 0.8;

}  // namespace

CornerNormals corner_normals(const Model& model, const Surface& surface, const Corners& corners) {
  const std::vector<glm::vec3> smooth = smooth_normals(model, surface);
  CornerNormals full;
  for (const Corner& corner : corners.corners)
    full.normals.emplace_back(corner.normal == Model::no_index ? smooth[corner.surface_vertex]
                                                               : model.normals[corner.normal]);
  full.areas.assign(corners.corners.size(), 0.0);
  for (std::size_t t = 0; t < corners.triangles.size(); ++t) {
    const Triangle& at = model.triangles[t];
    const double area =
        glm::length(area_vector(model.positions[at[0]], model.positions[at[1]], model.positions[at[2]])) / 3.0;
    for (const std::uint32_t corner : corners.triangles[t]) full.areas[corner] += area;
  }
  return full;
}

std::vector<glm::vec3> level_normals(const CornerNormals& full, std::span<const std::uint32_t> kept) {
  std::vector<glm::dvec3> all(kept.size(), glm::dvec3(0.0)), facing(all);
  for (std::size_t c = 0; c < kept.size(); ++c) all[kept[c]] += full.areas[c] * full.normals[c];
  for (std::size_t c = 0; c < kept.size(); ++c) {
    const double toward_mean = std::max(0.0, glm::dot(full.normals[c], all[kept[c]]));
    facing[kept[c]] += toward_mean * full.areas[c] * full.normals[c];
  }
  std::vector<glm::vec3> normals;
  normals.reserve(kept.size());
  for (std::size_t c = 0; c < kept.size(); ++c) {
    const double length = glm::length(facing[c]);
    const bool is_alone = length > 0.0 && glm::dot(full.normals[c], facing[c]) < alone * length;
    normals.emplace_back(is_alone ? facing[c] / length : full.normals[c]);
  }
  return normals;
}

}  // namespace semblante

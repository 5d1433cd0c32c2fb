#include "core/anatomy/part_shape.h"

#include <algorithm>
#include <map>

#include <glm/common.hpp>

#include "core/geometry/stitch.h"

namespace semblante {
namespace {

void count_triangles(const Model& model, const Surface& surface, std::vector<PartShape>& shapes) {
  std::vector<std::map<std::size_t, std::uint32_t>> of_primitive(shapes.size());  // triangles by primitive, by part
  const auto part_of = [&](const Triangle& t) { return surface.part_of[surface.surface_of[t[0]].value()].value(); };
  for (const Triangle& t : model.triangles) {
    if (has_three_corners(t)) ++shapes[part_of(t)].triangles;
  }
  for (std::size_t i = 0; i < model.primitives.size(); ++i) {
    const Primitive& primitive = model.primitives[i];
    std::uint32_t last = 0;
    std::uint32_t* count = nullptr;  // of the last triangle's part, which is the next one's as a rule
    for (std::uint32_t t = 0; t < primitive.triangle_count; ++t) {
      const std::uint32_t part = part_of(model.triangles[primitive.first_triangle + t]);
      if (count == nullptr || part != last) count = &of_primitive[part][i];
      last = part;
      ++*count;
    }
  }
  for (std::size_t p = 0; p < shapes.size(); ++p) {
    const auto most = std::max_element(of_primitive[p].begin(), of_primitive[p].end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most == of_primitive[p].end()) continue;
    const Primitive& primitive = model.primitives[most->first];
    shapes[p].name = primitive.name;
    if (primitive.material >= 0)
      shapes[p].material = model.materials[static_cast<std::size_t>(primitive.material)].name;
  }
}

}  // namespace

std::vector<PartShape> measure_parts(const Model& model, const Surface& surface) {
  std::vector<PartShape> shapes(surface.part_count());
  for (const SurfaceVertexId vertex : surface.surface_of)
    ++shapes[surface.part_of[vertex.value()].value()].file_vertices;
  count_triangles(model, surface, shapes);
  for (std::uint32_t p = 0; p < shapes.size(); ++p) {
    PartShape& shape = shapes[p];
    for (const SurfaceVertexId vertex : surface.members_of(PartId(p))) {
      shape.positions.push_back(surface.positions[vertex.value()]);
    }
    shape.low = shape.high = shape.positions.front();
    for (const glm::dvec3& position : shape.positions) {
      shape.low = glm::min(shape.low, position);
      shape.high = glm::max(shape.high, position);
      shape.center += position;
    }
    shape.center /= static_cast<double>(shape.positions.size());
    shape.sphere = fit_sphere(shape.positions);
  }
  return shapes;
}

bool is_ball(const PartShape& shape) {
  if (!shape.sphere) return false;
  // A cornea's bulge or an optic nerve causes a few per cent; a hemisphere is one radius deep along one axis.
  constexpr double rough = 0.08;
  constexpr double least_extent = 0.9;
  const double radius = shape.sphere->radius;
  const glm::dvec3 extent = shape.extent();
  return shape.sphere->rms_error < rough * radius && std::min({extent.x, extent.y, extent.z}) > least_extent * radius;
}

}  // namespace semblante

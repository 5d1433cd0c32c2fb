#include "core/anatomy/iris.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "core/anatomy/flat_iris.h"
#include "core/anatomy/part_roles.h"
#include "core/anatomy/point_lookup.h"
#include "core/anatomy/pupil_hole.h"
#include "core/geometry/triangle_shape.h"
#include "core/types/iris_size.h"

namespace semblante {
namespace {

/// Coordinates of a place relative to an eye's axis: the distance from it, and the distance along it.
struct Polar {
  double radius = 0.0;
  double along = 0.0;
};

Polar seen_along(const glm::dvec3& axis, const glm::dvec3& pivot, const glm::dvec3& place) {
  const glm::dvec3 d = place - pivot;
  const double along = glm::dot(d, axis);
  return {glm::length(d - along * axis), along};
}

/// The vertices of one part of the eye within the iris, seen from the front.
struct Layer {
  std::vector<SurfaceVertexId> vertices;
  double mean_along = 0.0;
  double farthest_out = 0.0;  ///< of the whole part
  double depth = 0.0;         ///< of the whole part, along the axis
};

std::vector<Layer> layers_of(const Surface& surface, std::span<const Part> parts, PartRole role, const glm::dvec3& axis,
                             const glm::dvec3& pivot, double within) {
  std::vector<Layer> layers;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (parts[p].role != role) continue;
    Layer layer;
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const SurfaceVertexId v : surface.members_of(PartId(p))) {
      const Polar at = seen_along(axis, pivot, surface.positions[v.value()]);
      least = std::min(least, at.along);
      most = std::max(most, at.along);
      layer.farthest_out = std::max(layer.farthest_out, at.radius);
      if (at.along <= 0.0 || at.radius >= within) continue;
      layer.vertices.push_back(v);
      layer.mean_along += at.along;
    }
    if (layer.vertices.empty()) continue;
    layer.mean_along /= static_cast<double>(layer.vertices.size());
    layer.depth = most - least;
    layers.push_back(std::move(layer));
  }
  return layers;
}

/// Least squares of along = a + b r^2. One ring of vertices does not determine the bend: then that of a ball is used.
/// The bend is limited to an iris no deeper than wide, because the pivot may be close to the plane of a flat eye.
double bend_of(const Surface& surface, const std::vector<SurfaceVertexId>& vertices, const glm::dvec3& axis,
               const glm::dvec3& pivot, double iris_radius) {
  double n = 0.0;
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  for (const SurfaceVertexId v : vertices) {
    const Polar at = seen_along(axis, pivot, surface.positions[v.value()]);
    const double square = at.radius * at.radius;
    n += 1.0;
    x += square;
    y += at.along;
    xx += square * square;
    xy += square * at.along;
  }
  const double spread = xx / n - (x / n) * (x / n);
  const double scale = iris_radius * iris_radius;
  const double bend = spread < 1e-4 * scale * scale ? -0.5 * n / y : (xy / n - (x / n) * (y / n)) / spread;
  return std::clamp(bend, -1.0 / iris_radius, 1.0 / iris_radius);
}

/// Removes the outermost of several layers if it covers the middle of the iris: a ball with a hole for the iris does
/// not.
void remove_cornea(std::vector<Layer>& layers, const Surface& surface, const glm::dvec3& axis, const glm::dvec3& pivot,
                   double iris_radius) {
  if (layers.size() < 2) return;
  const auto outermost = std::max_element(layers.begin(), layers.end(),
                                          [](const Layer& a, const Layer& b) { return a.mean_along < b.mean_along; });
  const bool covers_middle =
      std::any_of(outermost->vertices.begin(), outermost->vertices.end(), [&](SurfaceVertexId v) {
        return seen_along(axis, pivot, surface.positions[v.value()]).radius < 0.6 * iris_radius;
      });
  const bool is_over_all = std::all_of(layers.begin(), layers.end(), [&](const Layer& other) {
    return &other == &*outermost || outermost->mean_along > other.mean_along;
  });
  if (covers_middle && is_over_all) layers.erase(outermost);
}

}  // namespace

std::optional<IrisOfEye> find_iris(const Model& model, const Surface& surface, std::span<const Part> parts,
                                   PartRole role, const FeaturePointSet& points, const glm::vec3& pivot,
                                   std::optional<double> iris_diameter, std::string& why_not) {
  const std::string pupil_name = role == PartRole::left_eye ? "3.5" : "3.6";
  const auto refuse = [&](std::string words) -> std::optional<IrisOfEye> {
    why_not = std::move(words);
    return std::nullopt;
  };
  if (!has_part(parts, role)) {
    return refuse("is no part");
  }
  const FeaturePoint* const pupil = find_point(points, pupil_name);
  if (pupil == nullptr) return refuse("has no pupil: " + pupil_name + " is not marked");
  if (!iris_diameter || !(*iris_diameter > 0.0)) return refuse("has an iris of unknown size: IRISD is not known");

  const glm::dvec3 center(pivot);
  glm::dvec3 middle(pupil->position);
  const auto direction = [&]() {
    const glm::dvec3 d = middle - center;
    const double length = glm::length(d);
    return length > 0.0 ? d / length : glm::dvec3(0.0, 0.0, 1.0);
  };
  double radius = iris_radius(*iris_diameter, parts, role);
  if (const auto hole = middle_of_pupil_hole(model, surface, parts, role, center, direction(), radius)) {
    middle = *hole;
  } else if (pupil->vertex) {
    const SurfaceVertexId marked = surface.surface_of[pupil->vertex->value()];
    if (const auto better = middle_of_flat_iris(model, surface, marked, direction())) middle = *better;
  }
  const glm::dvec3 axis = direction();

  IrisOfEye found;
  found.shape.axis = glm::vec3(axis);
  std::vector<Layer> layers = layers_of(surface, parts, role, axis, center, radius);
  remove_cornea(layers, surface, axis, center, radius);
  // A separate disc determines the size of the iris.
  if (layers.size() == 1 && layers[0].depth < 0.5 * layers[0].farthest_out && layers[0].farthest_out < 1.4 * radius) {
    radius = layers[0].farthest_out;
  }
  std::size_t moving = 0;
  for (const Layer& layer : layers) {
    found.vertices.insert(found.vertices.end(), layer.vertices.begin(), layer.vertices.end());
    for (const SurfaceVertexId v : layer.vertices) {
      const double r = seen_along(axis, center, surface.positions[v.value()]).radius;
      moving += r > 0.02 * radius && r < 0.97 * radius ? 1 : 0;
    }
  }
  if (moving < 3) return refuse("has no vertices between the middle of its pupil and the rim of its iris");
  std::sort(found.vertices.begin(), found.vertices.end());
  found.shape.pupil_radius = pupil_of_iris * static_cast<float>(radius);
  found.shape.iris_radius = static_cast<float>(radius);
  found.shape.bend = static_cast<float>(bend_of(surface, found.vertices, axis, center, radius));
  return found;
}

}  // namespace semblante

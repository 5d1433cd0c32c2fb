#include "core/anatomy/iris.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

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

/// The centre of the flat regular polygon with the corner `marked` at the front of an eye; nullopt if there is none.
std::optional<glm::dvec3> middle_of_flat_face(const Model& model, const Surface& surface, SurfaceVertexId marked,
                                              const glm::dvec3& axis) {
  constexpr double flat = 0.9945;            // cosine of six degrees: files may have only three decimals
  constexpr std::size_t most_corners = 256;  // of a face, and facets at the marked vertex
  struct Facet {
    std::array<SurfaceVertexId, 3> corners;
    glm::dvec3 normal;
  };
  std::vector<Facet> front;  // that face in about the same direction as the eye
  for (const Triangle& triangle : model.triangles) {
    Facet facet;
    for (std::size_t i = 0; i < 3; ++i) facet.corners[i] = surface.surface_of[triangle[i]];
    if (surface.part_of[facet.corners[0].value()] != surface.part_of[marked.value()]) continue;
    const auto at = [&](std::size_t i) -> const glm::dvec3& { return surface.positions[facet.corners[i].value()]; };
    const glm::dvec3 normal = area_vector(at(0), at(1), at(2));
    const double size = glm::length(normal);
    if (!(size > 0.0) || glm::dot(normal, axis) < 0.8 * size) continue;
    facet.normal = normal / size;
    front.push_back(facet);
  }
  const auto has = [](const Facet& facet, SurfaceVertexId v) {
    return std::find(facet.corners.begin(), facet.corners.end(), v) != facet.corners.end();
  };
  const auto face_of = [&](const Facet& seed) -> std::optional<glm::dvec3> {
    std::vector<SurfaceVertexId> corners(seed.corners.begin(), seed.corners.end());
    for (bool grown = true; grown;) {
      grown = false;
      for (const Facet& facet : front) {
        if (glm::dot(facet.normal, seed.normal) < flat) continue;
        const auto known = [&](SurfaceVertexId v) {
          return std::find(corners.begin(), corners.end(), v) != corners.end();
        };
        const auto count = std::count_if(facet.corners.begin(), facet.corners.end(), known);
        if (count != 2) continue;
        for (const SurfaceVertexId v : facet.corners) {
          if (!known(v)) corners.push_back(v);
        }
        if (corners.size() > most_corners) return std::nullopt;
        grown = true;
      }
    }
    if (corners.size() < 5) return std::nullopt;
    glm::dvec3 middle(0.0);
    for (const SurfaceVertexId v : corners) middle += surface.positions[v.value()];
    middle /= static_cast<double>(corners.size());
    double mean = 0.0;
    for (const SurfaceVertexId v : corners) mean += glm::distance(surface.positions[v.value()], middle);
    mean /= static_cast<double>(corners.size());
    for (const SurfaceVertexId v : corners) {
      // A vertex in the middle, or not a regular ring: keeps the marked point.
      if (std::abs(glm::distance(surface.positions[v.value()], middle) - mean) > 0.2 * mean) return std::nullopt;
    }
    return middle;
  };
  const auto around = std::count_if(front.begin(), front.end(), [&](const Facet& facet) { return has(facet, marked); });
  if (static_cast<std::size_t>(around) > most_corners) return std::nullopt;
  for (const Facet& facet : front) {
    if (!has(facet, marked)) continue;
    if (const auto middle = face_of(facet)) return middle;
  }
  return std::nullopt;
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

}  // namespace

std::optional<IrisOfEye> find_iris(const Model& model, const Surface& surface, std::span<const Part> parts,
                                   PartRole role, const FeaturePointSet& points, const glm::vec3& pivot,
                                   std::optional<double> iris_diameter, std::string& why_not) {
  const std::string pupil_name = role == PartRole::left_eye ? "3.5" : "3.6";
  const auto refuse = [&](std::string words) -> std::optional<IrisOfEye> {
    why_not = std::move(words);
    return std::nullopt;
  };
  if (std::none_of(parts.begin(), parts.end(), [&](const Part& p) { return p.role == role; })) {
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
    if (const auto better = middle_of_flat_face(model, surface, marked, direction())) middle = *better;
  }
  const glm::dvec3 axis = direction();

  IrisOfEye found;
  found.shape.axis = glm::vec3(axis);
  std::vector<Layer> layers = layers_of(surface, parts, role, axis, center, radius);
  // In front of another layer, and also in front of the middle of the iris: excludes a ball with a hole for the iris.
  const auto lies_over = [&](const Layer& a, const Layer& b) {
    const bool covers = std::any_of(a.vertices.begin(), a.vertices.end(), [&](SurfaceVertexId v) {
      return seen_along(axis, center, surface.positions[v.value()]).radius < 0.6 * radius;
    });
    return covers && a.mean_along > b.mean_along;
  };
  if (layers.size() > 1) {
    const auto outermost = std::max_element(layers.begin(), layers.end(),
                                            [](const Layer& a, const Layer& b) { return a.mean_along < b.mean_along; });
    const bool over_all = std::all_of(layers.begin(), layers.end(), [&](const Layer& other) {
      return &other == &*outermost || lies_over(*outermost, other);
    });
    if (over_all) layers.erase(outermost);
  }
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

#include "core/anatomy/point_lookup.h"

#include <algorithm>
#include <cassert>

namespace semblante {

const FeaturePoint* find_point(const FeaturePointSet& points, std::string_view name) {
  const std::optional<FeaturePointId> id = parse_feature_point(name);
  assert(id);
  return find_point(points, *id);
}

std::vector<SurfacePoint> surface_points(const Surface& surface, const FeaturePointSet& points) {
  std::vector<SurfacePoint> found;
  for (const FeaturePoint& point : points) {
    if (!point.vertex) continue;
    const SurfaceVertexId vertex = surface.surface_of[point.vertex->value()];
    found.push_back({point.id, vertex, surface.positions[vertex.value()]});
  }
  std::sort(found.begin(), found.end(), [](const SurfacePoint& a, const SurfacePoint& b) { return a.id < b.id; });
  return found;
}

const SurfacePoint* point_named(std::span<const SurfacePoint> points, std::string_view name) {
  const auto id = parse_feature_point(name);
  const auto found = std::find_if(points.begin(), points.end(), [&](const SurfacePoint& p) { return p.id == *id; });
  return found == points.end() ? nullptr : &*found;
}

bool is_pupil(FeaturePointId id) {
  const std::string name = to_string(id);
  return name == "3.5" || name == "3.6";
}

}  // namespace semblante

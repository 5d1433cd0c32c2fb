#include "core/doctor/surface_way.h"

#include <algorithm>
#include <limits>

namespace semblante {

const SurfacePoint* point_named(std::span<const SurfacePoint> points, std::string_view name) {
  const auto id = parse_feature_point(name);
  const auto found = std::find_if(points.begin(), points.end(), [&](const SurfacePoint& p) { return p.id == *id; });
  return found == points.end() ? nullptr : &*found;
}

std::vector<SurfaceVertexId> way_back(const Surface& surface, std::span<const double> distances, SurfaceVertexId to) {
  std::vector<SurfaceVertexId> way{to};
  while (distances[way.back().value()] > 0.0) {
    const double here = distances[way.back().value()];
    const Surface::Step* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Surface::Step& step : surface.steps_from(way.back())) {
      const double before = distances[step.to.value()];
      if (before >= here || before + step.length >= least) continue;
      least = before + step.length;
      best = &step;
    }
    if (best == nullptr) break;  // only zero-length steps are left
    way.push_back(best->to);
  }
  return way;
}

}  // namespace semblante

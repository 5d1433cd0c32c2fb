#include "core/doctor/surface_way.h"

#include <limits>

namespace semblante {

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

#include "core/doctor/rim_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include <glm/geometric.hpp>

#include "core/anatomy/rim_sides.h"

namespace semblante {
namespace {

/// The nearest vertex certainly on the side of a point, on the part of its vertex.
std::optional<SurfaceVertexId> nearest_on_side(const Surface& surface, const RimSides& sides, const SurfacePoint& point,
                                               bool is_upper, const std::unordered_set<std::uint32_t>& taken) {
  std::optional<SurfaceVertexId> best;
  double least = std::numeric_limits<double>::infinity();
  for (const SurfaceVertexId v : surface.members_of(surface.part_of[point.vertex.value()])) {
    const double away = glm::distance(surface.positions[v.value()], point.position);
    if (away >= least || taken.contains(v.value()) || surface.steps_from(v).empty()) continue;
    if (sides.side(v, is_upper) < RimSides::clear) continue;
    least = away;
    best = v;
  }
  return best;
}

}  // namespace

std::vector<MisplacedRimPoint> find_misplaced_rim_points(const Surface& surface, std::span<const SurfacePoint> points) {
  std::vector<SurfacePoint> anchors;
  std::unordered_set<std::uint32_t> taken;
  for (const SurfacePoint& point : points) {
    taken.insert(point.vertex.value());
    if (rim_of_point(point.id).opening == nullptr) anchors.push_back(point);
  }
  std::vector<MisplacedRimPoint> misplaced;
  for (const mpeg4::Opening& opening : mpeg4::openings) {
    const RimSides sides(surface, opening, anchors);
    for (const SurfacePoint& point : points) {
      const RimOfPoint rim = rim_of_point(point.id);
      if (rim.opening != &opening || sides.side(point.vertex, rim.is_upper) > -RimSides::clear) continue;
      const auto nearest = nearest_on_side(surface, sides, point, rim.is_upper, taken);
      if (nearest) taken.insert(nearest->value());
      misplaced.push_back({point, &opening, rim.is_upper, nearest});
    }
  }
  return misplaced;
}

bool is_misplaced(std::span<const MisplacedRimPoint> misplaced, FeaturePointId id) {
  return std::any_of(misplaced.begin(), misplaced.end(), [&](const MisplacedRimPoint& m) { return m.point.id == id; });
}

}  // namespace semblante

#include "core/anatomy/rim_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include <glm/geometric.hpp>

#include "core/anatomy/rim_sides.h"
#include "core/geometry/edge_path_search.h"

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

/// Whether the surface joins the rims between two vertices: the path is shorter than half of that around the nearer
/// corner.
bool are_joined(const Surface& surface, const mpeg4::Opening& opening, std::span<const SurfacePoint> points,
                const SurfacePoint& from, SurfaceVertexId to, EdgePathSearch& search) {
  const glm::dvec3& end = surface.positions[to.value()];
  double round = std::numeric_limits<double>::infinity();
  for (const std::string_view name : opening.corners) {
    if (const SurfacePoint* const corner = point_named(points, name))
      round = std::min(round, glm::distance(from.position, corner->position) + glm::distance(corner->position, end));
  }
  return search.from(from.vertex)[to.value()] < 0.5 * round;
}

}  // namespace

std::vector<MisplacedRimPoint> find_misplaced_rim_points(const Surface& surface, std::span<const SurfacePoint> points) {
  std::vector<SurfacePoint> anchors;
  std::unordered_set<std::uint32_t> taken;
  for (const SurfacePoint& point : points) {
    taken.insert(point.vertex.value());
    if (rim_of_point(point.id).opening == nullptr) anchors.push_back(point);
  }
  EdgePathSearch search(surface);
  std::vector<MisplacedRimPoint> misplaced;
  for (const mpeg4::Opening& opening : mpeg4::openings) {
    const RimSides sides(surface, opening, anchors);
    for (const SurfacePoint& point : points) {
      const RimOfPoint rim = rim_of_point(point.id);
      if (rim.opening != &opening || sides.side(point.vertex, rim.is_upper) > -RimSides::clear) continue;
      const auto nearest = nearest_on_side(surface, sides, point, rim.is_upper, taken);
      // Across a bridge the point is near its own side along the surface: then the mesh is at fault, not the point.
      if (!nearest || are_joined(surface, opening, points, point, *nearest, search)) continue;
      taken.insert(nearest->value());
      misplaced.push_back({point, &opening, rim.is_upper, *nearest});
    }
  }
  // If most points of a side seem to be on the other one, the surface is at fault: a bridge leads there.
  std::erase_if(misplaced, [all = misplaced, points](const MisplacedRimPoint& m) {
    const auto is_fellow = [&](FeaturePointId id) {
      const RimOfPoint rim = rim_of_point(id);
      return rim.opening == m.opening && rim.is_upper == m.is_upper;
    };
    const auto marked =
        std::count_if(points.begin(), points.end(), [&](const SurfacePoint& p) { return is_fellow(p.id); });
    const auto wrong =
        std::count_if(all.begin(), all.end(), [&](const MisplacedRimPoint& p) { return is_fellow(p.point.id); });
    return 2 * wrong > marked;
  });
  return misplaced;
}

bool is_misplaced(std::span<const MisplacedRimPoint> misplaced, FeaturePointId id) {
  return std::any_of(misplaced.begin(), misplaced.end(), [&](const MisplacedRimPoint& m) { return m.point.id == id; });
}

}  // namespace semblante

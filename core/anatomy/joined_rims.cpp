#include "core/anatomy/joined_rims.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "core/geometry/shortest_path.h"

namespace semblante {
namespace {

/// Of the area of a triangle that would turn over: squeezed to less it stands edge-on and is seen as a dark line.
constexpr double least_kept = 1.0 / 3.0;
/// The area that may be squeezed more, as a fraction of the area that the closing takes away: a sliver beside a corner
/// does not keep an eye open.
constexpr double squeezed_share = 0.01;
constexpr int halvings = 20;

double length_of(const Surface& surface, std::span<const SurfaceVertexId> path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length += glm::distance(surface.positions[path[i - 1].value()], surface.positions[path[i].value()]);
  }
  return length;
}

/// The straight way from rim to rim around the nearer corner: a lower bound that does not depend on the mesh.
double way_around(const SurfacePoint& upper, const SurfacePoint& lower, const mpeg4::Opening& opening,
                  std::span<const SurfacePoint> points) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const std::string_view name : opening.corners) {
    const SurfacePoint* const corner = point_named(points, name);
    if (corner == nullptr) continue;
    shortest = std::min(
        shortest, glm::distance(upper.position, corner->position) + glm::distance(corner->position, lower.position));
  }
  return shortest;
}

/// Whether a ball hides a place from the front.
bool is_behind(const Sphere& ball, const glm::dvec3& place) {
  const glm::dvec3 from = place - ball.center;
  const double front = ball.radius * ball.radius - from.x * from.x - from.y * from.y;
  return front > 0.0 && from.z < std::sqrt(front);
}

}  // namespace

std::optional<RimCrossing> shortest_crossing(const Surface& surface, const mpeg4::Opening& opening,
                                             std::span<const SurfacePoint> points) {
  std::optional<RimCrossing> shortest;
  for (std::size_t i = 0; i < opening.upper.size(); ++i) {
    const SurfacePoint* const upper = point_named(points, opening.upper[i]);
    const SurfacePoint* const lower = point_named(points, opening.lower[i]);
    if (upper == nullptr || lower == nullptr) continue;
    if (upper->vertex == lower->vertex) return RimCrossing{*upper, *lower, 0.0, {upper->vertex}};
    const double around = way_around(*upper, *lower, opening, points);
    if (!std::isfinite(around) || around == 0.0) continue;
    std::vector<SurfaceVertexId> way = shortest_path(surface, lower->vertex, upper->vertex);
    const double share = way.empty() ? std::numeric_limits<double>::infinity() : length_of(surface, way) / around;
    if (!shortest || share < shortest->share) shortest = RimCrossing{*upper, *lower, share, std::move(way)};
  }
  return shortest;
}

bool joins(const RimCrossing& crossing, const Surface& surface, const std::optional<Sphere>& ball) {
  if (!(crossing.share < joined_share)) return false;
  return !ball || std::none_of(crossing.way.begin(), crossing.way.end(),
                               [&](SurfaceVertexId v) { return is_behind(*ball, surface.positions[v.value()]); });
}

bool are_joined(const Surface& surface, const mpeg4::Opening& opening, std::span<const SurfacePoint> points,
                const std::optional<Sphere>& ball) {
  const auto crossing = shortest_crossing(surface, opening, points);
  return crossing && joins(*crossing, surface, ball);
}

double share_before_fold(const Model& model, const Rig& rig, const Heights& heights) {
  const auto height_of = [&](std::uint32_t vertex) {
    const auto points = rig.influence.points_of(vertex);
    const auto weights = rig.influence.weights_of(vertex);
    double sum = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      sum += static_cast<double>(weights[k]) * heights[points[k].value()];
    }
    return sum;
  };
  // Seen from the front only heights change, so the signed area of a triangle is linear in the share.
  struct Shrinking {
    double spare, loss;
  };
  std::vector<Shrinking> triangles;
  double lost = 0.0;
  for (const Triangle& t : model.triangles) {
    if (rig.parts[rig.part_of_vertex[t[0]].value()].role != PartRole::skin) continue;
    const glm::dvec3 a(model.positions[t[0]]);
    const glm::dvec3 b(model.positions[t[1]]);
    const glm::dvec3 c(model.positions[t[2]]);
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (!(area > 0.0)) continue;
    const double from = height_of(t[0]);
    const double gain = (b.x - a.x) * (height_of(t[2]) - from) - (c.x - a.x) * (height_of(t[1]) - from);
    if (!(gain < 0.0)) continue;
    lost -= gain;
    if (area + gain < 0.0) triangles.push_back({(1.0 - least_kept) * area, -gain});
  }
  const auto squeezed = [&](double share) {
    double sum = 0.0;
    for (const Shrinking& t : triangles) sum += std::max(0.0, share * t.loss - t.spare);
    return sum;
  };
  const double greatest = squeezed_share * lost;
  if (squeezed(1.0) <= greatest) return 1.0;
  double low = 0.0;
  double high = 1.0;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    (squeezed(middle) <= greatest ? low : high) = middle;
  }
  return low;
}

}  // namespace semblante

#include "core/anatomy/points_on_eyes.h"

#include <algorithm>
#include <array>
#include <optional>

#include <glm/geometric.hpp>

#include "core/anatomy/joined_rims.h"
#include "core/anatomy/modelled_eye.h"
#include "core/anatomy/modelled_rims.h"
#include "core/anatomy/part_roles.h"

namespace semblante {
namespace {

/// The least height of an eye that is looked for, as a share of its width: a point on the eye makes it look lower.
constexpr double least_height = 0.3;
/// The height from which on the lids may be open, in the same unit: half of an eye's.
constexpr double least_open = 0.15;

/// The points of an eye's lids: upper, lower, and the corners as the face has them.
using LidPoints = std::array<const SurfacePoint*, 4>;

std::optional<LidPoints> points_of(const mpeg4::Opening& lids, std::span<const SurfacePoint> points) {
  const LidPoints of_lids = {point_named(points, lids.upper.front()), point_named(points, lids.lower.front()),
                             point_named(points, lids.corners[0]), point_named(points, lids.corners[1])};
  if (std::find(of_lids.begin(), of_lids.end(), nullptr) != of_lids.end()) return std::nullopt;
  return of_lids;
}

/// A closed lid is a smooth patch too, from its fold to its edge.
bool is_open(const LidPoints& lids) {
  const auto& [upper, lower, left, right] = lids;
  return upper->position.y - lower->position.y > least_open * glm::distance(left->position, right->position);
}

/// Where the eye is looked for: about the points of its lids, as wide as the wider of both eyes.
LidPlaces expected_about(const LidPoints& lids, std::span<const SurfacePoint> points) {
  double width = 0.0;
  double height = 0.0;
  for (const std::size_t eye : {0U, 1U}) {
    const auto either = points_of(mpeg4::lids_of(eye), points);
    if (!either) continue;
    const auto& [upper, lower, left, right] = *either;
    width = std::max(width, glm::distance(left->position, right->position));
    height = std::max(height, upper->position.y - lower->position.y);
  }
  height = std::max(height, least_height * width);
  glm::dvec3 middle(0.0);
  for (const SurfacePoint* const point : lids) middle += 0.25 * point->position;
  const glm::dvec3 up(0.0, 0.5 * height, 0.0);
  const glm::dvec3 aside(0.5 * width, 0.0, 0.0);
  return {middle + up, middle - up, middle + aside, middle - aside};
}

/// Lids that are thin lie on the ball of the eye too, but beside what is seen of it.
bool is_on_eye(const Surface& surface, const ModelledRims& rims, SurfaceVertexId vertex) {
  return rims.is_of_eye(vertex) && rims.surround(surface.positions[vertex.value()]);
}

/// The vertex of a part that is nearest to a place, of those that have no point and do not lie on the eye. For a corner
/// those on the eye's ball beside it are left out too: `find_modelled_eyes` closes no lids whose corner is one.
std::optional<SurfaceVertexId> nearest_beside(const Surface& surface, PartId part, const ModelledRims& rims,
                                              std::span<const SurfacePoint> points, const glm::dvec3& place,
                                              bool is_corner) {
  std::optional<SurfaceVertexId> nearest;
  double least = 0.0;
  for (const SurfaceVertexId v : surface.members_of(part)) {
    const double distance = glm::distance(surface.positions[v.value()], place);
    if (nearest && distance >= least) continue;
    if (is_corner ? rims.is_of_eye(v) : is_on_eye(surface, rims, v)) continue;
    if (std::any_of(points.begin(), points.end(), [&](const auto& p) { return p.vertex == v; })) continue;
    least = distance;
    nearest = v;
  }
  return nearest;
}

std::vector<PointOnEye> points_on_eye(const Surface& surface, std::span<const Triangle> triangles,
                                      std::span<const SurfacePoint> points, const mpeg4::Opening& lids) {
  std::vector<PointOnEye> found;
  const auto of_lids = points_of(lids, points);
  if (!of_lids || !is_open(*of_lids) || !are_joined(surface, lids, points)) return found;
  const PartId part = surface.part_of[of_lids->front()->vertex.value()];
  const auto rims = find_modelled_rims(surface, surface.positions, triangles, part, expected_about(*of_lids, points));
  if (!rims) return found;
  std::vector<SurfacePoint> taken(points.begin(), points.end());
  for (std::size_t k = 0; k < of_lids->size(); ++k) {
    const SurfacePoint& point = *(*of_lids)[k];
    if (!is_on_eye(surface, *rims, point.vertex)) continue;
    const ModelledRims::Column& edges = rims->at(point.position.x);
    const std::array<glm::dvec3, 4> places = {edges.upper, edges.lower, rims->left, rims->right};
    const auto edge = nearest_beside(surface, part, *rims, taken, places[k], k >= 2);
    if (!edge) return {};
    taken.push_back({point.id, *edge, surface.positions[edge->value()]});
    found.push_back({point, &lids, *edge});
  }
  return found;
}

}  // namespace

std::vector<PointOnEye> find_points_on_eyes(const Surface& surface, std::span<const Triangle> triangles,
                                            std::span<const Part> parts, std::span<const SurfacePoint> points) {
  std::vector<PointOnEye> all;
  std::vector<SurfacePoint> moved(points.begin(), points.end());
  for (const std::size_t eye : {0U, 1U}) {
    if (has_part(parts, eyeball_role(eye))) continue;
    const std::vector<PointOnEye> found = points_on_eye(surface, triangles, points, mpeg4::lids_of(eye));
    for (const PointOnEye& on : found) {
      const auto at = std::find_if(moved.begin(), moved.end(), [&](const auto& p) { return p.id == on.point.id; });
      *at = {on.point.id, on.edge, surface.positions[on.edge.value()]};
    }
    all.insert(all.end(), found.begin(), found.end());
  }
  if (all.empty()) return all;
  const ModelledEyes before = find_modelled_eyes(surface, triangles, parts, points);
  const ModelledEyes after = find_modelled_eyes(surface, triangles, parts, moved);
  for (const std::size_t eye : {0U, 1U}) {
    const mpeg4::Opening& lids = mpeg4::lids_of(eye);
    if (before[eye] || !after[eye]) std::erase_if(all, [&](const auto& p) { return p.lids == &lids; });
  }
  return all;
}

}  // namespace semblante

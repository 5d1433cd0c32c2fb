#include "core/anatomy/lid_edge.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include <glm/geometric.hpp>

#include "core/anatomy/part_roles.h"
#include "core/anatomy/pivots.h"
#include "core/geometry/shortest_path.h"

namespace semblante {
namespace {

/// Maximum distance of a corner from the lid's part if it is not a vertex of that part, as a fraction of the eye's
/// width.
constexpr double greatest_step_to_corner = 0.25;
/// An edge that reaches beyond its corner by more than this fraction of the eye's width, along x, is the one that ends
/// there: the corner's point is beside the end of the opening. Edges of fine meshes reach beyond it by 0.011 at most.
constexpr double least_step_beyond_corner = 0.02;

const SurfacePoint* find(std::span<const SurfacePoint> points, std::string_view name) {
  const auto at = std::find_if(points.begin(), points.end(),
                               [&](const SurfacePoint& p) { return p.id == parse_feature_point(name); });
  return at != points.end() ? &*at : nullptr;
}

/// A place is hidden in the eyeball if it is deeper in it than this share of the ball's radius, and deeper than the
/// middle of the lid's edge by the other one: that of lids which the ball pierces lies in it too.
constexpr double least_depth = 0.04;
constexpr double least_depth_behind_middle = 0.05;
/// A step to a hidden place counts as so many: from a corner that is one, the way back to the edge that is seen is
/// shorter than that along the inside.
constexpr double cost_of_hidden = 4.0;

StepCost cost_behind(const std::optional<Sphere>& ball, const Surface& surface, const glm::dvec3& middle) {
  if (!ball) return {};
  const double hidden = std::min((1.0 - least_depth) * ball->radius,
                                 glm::distance(middle, ball->center) - least_depth_behind_middle * ball->radius);
  return [&surface, hidden, center = ball->center](SurfaceVertexId v) {
    return glm::distance(surface.positions[v.value()], center) < hidden ? cost_of_hidden : 1.0;
  };
}

SurfaceVertexId nearest_of_part(const Surface& surface, PartId part, const glm::dvec3& to) {
  const auto members = surface.members_of(part);
  return *std::min_element(members.begin(), members.end(), [&](SurfaceVertexId a, SurfaceVertexId b) {
    return glm::distance(surface.positions[a.value()], to) < glm::distance(surface.positions[b.value()], to);
  });
}

std::optional<LidEdge> lid_edge(const Surface& surface, std::span<const SurfacePoint> points, std::string_view middle,
                                const std::array<std::string_view, 2>& corners, const std::optional<Sphere>& ball) {
  const SurfacePoint* const at_middle = find(points, middle);
  const std::array<const SurfacePoint*, 2> at_corners = {find(points, corners[0]), find(points, corners[1])};
  if (at_middle == nullptr || at_corners[0] == nullptr || at_corners[1] == nullptr) return std::nullopt;
  LidEdge edge;
  edge.middle = *at_middle;
  edge.corners = {*at_corners[0], *at_corners[1]};
  const PartId part = surface.part_of[edge.middle.vertex.value()];
  const double width = glm::distance(edge.corners[0].position, edge.corners[1].position);
  const StepCost cost = cost_behind(ball, surface, edge.middle.position);
  for (std::size_t c = 0; c < 2; ++c) {
    SurfaceVertexId end = edge.corners[c].vertex;
    edge.ends_at_corner[c] = surface.part_of[end.value()] == part;
    if (!edge.ends_at_corner[c]) {
      end = nearest_of_part(surface, part, edge.corners[c].position);
      const double step = glm::distance(surface.positions[end.value()], edge.corners[c].position);
      if (step > greatest_step_to_corner * width) return std::nullopt;
    }
    edge.to_corner[c] = shortest_path(surface, edge.middle.vertex, end, cost);
  }
  return edge;
}

/// If `edge` goes past corner `c` and back, its way back becomes part of `other`.
void meet_at_end_of_opening(const Surface& surface, std::size_t c, LidEdge& edge, LidEdge& other) {
  if (!edge.ends_at_corner[c] || !other.ends_at_corner[c]) return;
  const double across = edge.corners[c].position.x - edge.corners[1 - c].position.x;
  const auto beyond_corner = [&](SurfaceVertexId v) {
    return (surface.positions[v.value()].x - edge.corners[c].position.x) * (across < 0.0 ? -1.0 : 1.0);
  };
  auto& path = edge.to_corner[c];
  const auto end = std::max_element(path.begin(), path.end(), [&](SurfaceVertexId a, SurfaceVertexId b) {
    return beyond_corner(a) < beyond_corner(b);
  });
  if (end == path.end() || !(beyond_corner(*end) > least_step_beyond_corner * std::abs(across))) return;
  other.to_corner[c].insert(other.to_corner[c].end(), std::next(path.rbegin()), std::make_reverse_iterator(end));
  path.erase(std::next(end), path.end());
  edge.ends_at_corner[c] = other.ends_at_corner[c] = false;
}

}  // namespace

std::optional<EyeEdges> find_eye_edges(const Surface& surface, std::span<const SurfacePoint> points, std::size_t eye,
                                       std::span<const Part> parts) {
  const std::array<std::string_view, 2> corners =
      eye == 0 ? std::array<std::string_view, 2>{"3.11", "3.7"} : std::array<std::string_view, 2>{"3.8", "3.12"};
  const std::optional<Sphere> ball = round_eyeball(surface, parts, eyeball_role(eye));
  auto upper = lid_edge(surface, points, eye == 0 ? "3.1" : "3.2", corners, ball);
  auto lower = lid_edge(surface, points, eye == 0 ? "3.3" : "3.4", corners, ball);
  if (!upper || !lower) return std::nullopt;
  for (std::size_t c = 0; c < 2; ++c) {
    meet_at_end_of_opening(surface, c, *upper, *lower);
    meet_at_end_of_opening(surface, c, *lower, *upper);
  }
  return EyeEdges{*std::move(upper), *std::move(lower)};
}

}  // namespace semblante

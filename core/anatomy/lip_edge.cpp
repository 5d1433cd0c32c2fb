#include "core/anatomy/lip_edge.h"

#include <algorithm>
#include <string_view>

#include <glm/geometric.hpp>

#include "core/geometry/open_edge.h"
#include "core/geometry/shortest_path.h"

namespace semblante {
namespace {

using Names = std::array<std::string_view, 5>;
constexpr Names upper_lip = {"2.5", "2.7", "2.2", "2.6", "2.4"};
constexpr Names lower_lip = {"2.5", "2.9", "2.3", "2.8", "2.4"};
constexpr std::size_t middle = 2;

std::vector<SurfaceVertexId> open_steps(const Surface& surface, SurfaceVertexId vertex) {
  std::vector<SurfaceVertexId> steps;
  for (const Surface::Step& step : surface.steps_from(vertex)) {
    if (is_open_edge(surface, vertex, step.to)) steps.push_back(step.to);
  }
  return steps;
}

/// The border of the surface from a vertex on it, first to a neighbour on it: around a hole, or to where borders meet.
std::vector<SurfaceVertexId> border_from(const Surface& surface, SurfaceVertexId start, SurfaceVertexId to) {
  std::vector<SurfaceVertexId> line = {start};
  while (to != start && line.size() < surface.vertex_count()) {
    const SurfaceVertexId before = line.back();
    line.push_back(to);
    const std::vector<SurfaceVertexId> steps = open_steps(surface, to);
    if (steps.size() != 2) break;
    to = steps[0] == before ? steps[1] : steps[0];
  }
  return line;
}

/// The border from the middle of a lip to the vertices of it that are nearest to the corners, by rising x. Empty where
/// the mouth is no hole in the surface.
std::vector<SurfaceVertexId> border_of_lip(const Surface& surface, const LipEdge& lip) {
  const SurfacePoint* const at = lip.points[middle];
  if (at == nullptr || lip.points.front() == nullptr || lip.points.back() == nullptr) return {};
  const auto x_of = [&](SurfaceVertexId v) { return surface.positions[v.value()].x; };
  const auto from_right = [&](SurfaceVertexId v, SurfaceVertexId w) { return x_of(v) < x_of(w); };
  std::vector<SurfaceVertexId> steps = open_steps(surface, at->vertex);
  if (steps.size() != 2) return {};
  std::sort(steps.begin(), steps.end(), from_right);
  std::vector<SurfaceVertexId> border;
  for (const auto& [corner, step] : {std::pair(lip.points.front(), steps[0]), std::pair(lip.points.back(), steps[1])}) {
    const std::vector<SurfaceVertexId> line = border_from(surface, at->vertex, step);
    const auto away = [&, corner = corner](SurfaceVertexId v) {
      return glm::distance(surface.positions[v.value()], corner->position);
    };
    const auto end = std::min_element(line.begin(), line.end(),
                                      [&](SurfaceVertexId v, SurfaceVertexId w) { return away(v) < away(w); });
    border.insert(border.end(), line.begin(), end + 1);
  }
  std::sort(border.begin(), border.end(), from_right);
  return border;
}

LipEdge with_points(std::span<const SurfacePoint> points, const Names& names) {
  LipEdge lip;
  for (std::size_t i = 0; i < names.size(); ++i) lip.points[i] = point_named(points, names[i]);
  return lip;
}

LipEdge find_lip_edge(const Surface& surface, std::span<const SurfacePoint> points, const Names& names) {
  LipEdge lip = with_points(points, names);
  const std::vector<SurfaceVertexId> border = border_of_lip(surface, lip);
  for (std::size_t i = 0; i < lip.between.size(); ++i) {
    const SurfacePoint* const a = lip.points[i];
    const SurfacePoint* const b = lip.points[i + 1];
    if (a == nullptr || b == nullptr) continue;
    std::vector<SurfaceVertexId>& line = lip.between[i];
    if (border.empty()) {
      line = shortest_path(surface, a->vertex, b->vertex);
      continue;
    }
    line.push_back(a->vertex);
    for (const SurfaceVertexId v : border) {
      const double x = surface.positions[v.value()].x;
      if (v != a->vertex && v != b->vertex && x > a->position.x && x <= b->position.x) line.push_back(v);
    }
    line.push_back(b->vertex);
  }
  return lip;
}

}  // namespace

std::vector<SurfaceVertexId> border_of_mouth(const Surface& surface, std::span<const SurfacePoint> points) {
  std::vector<SurfaceVertexId> border = border_of_lip(surface, with_points(points, upper_lip));
  const std::vector<SurfaceVertexId> lower = border_of_lip(surface, with_points(points, lower_lip));
  border.insert(border.end(), lower.begin(), lower.end());
  return border;
}

LipEdges find_lip_edges(const Surface& surface, std::span<const SurfacePoint> points) {
  return {find_lip_edge(surface, points, upper_lip), find_lip_edge(surface, points, lower_lip)};
}

}  // namespace semblante

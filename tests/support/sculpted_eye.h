#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/rig.h"
#include "tests/support/meshes.h"

namespace semblante::testing {

/// Of the ball.
inline constexpr double sculpted_radius = 1.2;

/// The upper edge of the opening: an arc from corner to corner, 0.35 high; the lower one is its mirror image.
inline double sculpted_edge(double x) { return 0.35 * (1.0 - x * x); }

/// One sheet of skin over a ball of radius 1.2 about the origin, with an opening two units wide in which the ball is
/// seen; skin around it stands `step` before the ball.
struct SculptedEye {
  explicit SculptedEye(double step, int columns = 60, int rows = 48) {
    for (int r = 0; r <= rows; ++r) {
      for (int c = 0; c <= columns; ++c) {
        const double x = -1.15 + 2.3 * c / columns;
        const double y = -0.7 + 1.4 * r / rows;
        const bool is_eye = std::abs(x) < 1.0 && std::abs(y) < sculpted_edge(x);
        const double z = std::sqrt(std::max(0.0, sculpted_radius * sculpted_radius - x * x - y * y));
        model.positions.emplace_back(x, y, z + (is_eye ? 0.0 : step));
      }
    }
    const auto at = [columns](int r, int c) { return static_cast<std::uint32_t>(r * (columns + 1) + c); };
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {
        model.triangles.push_back({at(r, c), at(r, c + 1), at(r + 1, c + 1)});
        model.triangles.push_back({at(r, c), at(r + 1, c + 1), at(r + 1, c)});
      }
    }
    surface = build_surface(model);
    parts.emplace_back().role = PartRole::skin;
    // The rows above and below the opening, and the columns beside it.
    mark("3.1", 0.0, sculpted_edge(0.0) + 0.03);
    mark("3.3", 0.0, -sculpted_edge(0.0) - 0.03);
    mark("3.7", 1.02, 0.0);
    mark("3.11", -1.02, 0.0);
  }

  void mark(const char* name, double x, double y) {
    const auto id = parse_feature_point(name).value();
    std::erase_if(points, [id](const SurfacePoint& p) { return p.id == id; });
    SurfaceVertexId best(0);
    const auto off = [&](SurfaceVertexId v) {
      return std::hypot(surface.positions[v.value()].x - x, surface.positions[v.value()].y - y);
    };
    for (std::uint32_t v = 0; v < surface.vertex_count(); ++v) {
      if (off(SurfaceVertexId(v)) < off(best)) best = SurfaceVertexId(v);
    }
    points.push_back({id, best, surface.positions[best.value()]});
    std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  }

  [[nodiscard]] const SurfacePoint& point(const char* name) const { return *point_named(points, name); }

  Model model;
  Surface surface;
  std::vector<Part> parts;
  std::vector<SurfacePoint> points;
};

/// The lids of `SculptedEye` around a hole, and a whole ball behind them that shares `is_welded` vertices with the
/// lower.
inline SculptedEye ball_behind_lids(bool is_welded, int columns = 60, int rows = 48) {
  SculptedEye head(0.08, columns, rows);
  Model& model = head.model;
  const auto sheet = static_cast<std::uint32_t>(model.positions.size());
  const auto is_eye = [&](std::uint32_t v) { return glm::length(model.positions[v]) < sculpted_radius + 1e-4; };
  std::vector<bool> on_hole(sheet, false);
  std::erase_if(model.triangles, [&](const Triangle& t) {
    if (std::none_of(t.begin(), t.end(), is_eye)) return false;
    for (const std::uint32_t v : t) on_hole[v] = on_hole[v] || !is_eye(v);
    return true;
  });
  const Model ball = make_ball(glm::vec3(0.0F), static_cast<float>(sculpted_radius), 64, 32);
  model.positions.insert(model.positions.end(), ball.positions.begin(), ball.positions.end());
  for (Triangle t : ball.triangles) {
    for (std::uint32_t& corner : t) {
      const glm::vec3& p = ball.positions[corner];
      corner += sheet;
      if (!is_welded || p.z < 0.0F) continue;
      for (std::uint32_t v = 0; v < sheet; ++v) {
        if (on_hole[v] && model.positions[v].y < 0.0F && glm::distance(model.positions[v], p) < 0.1F) corner = v;
      }
    }
    model.triangles.push_back(t);
  }
  std::vector<std::uint32_t> marked;
  for (const SurfacePoint& p : head.points) marked.push_back(head.surface.file_vertex_of[p.vertex.value()].value());
  head.surface = build_surface(model);
  for (std::size_t k = 0; k < marked.size(); ++k) head.points[k].vertex = head.surface.surface_of[marked[k]];
  head.parts.resize(head.surface.part_count(), head.parts.front());
  return head;
}

/// `ball_behind_lids` with lids that are thick: from their edges an inside goes back into the ball. The outer corner is
/// marked on that.
inline SculptedEye ball_behind_thick_lids() {
  SculptedEye head = ball_behind_lids(false);
  Model& model = head.model;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> triangles_at;
  for (const Triangle& t : model.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++triangles_at[std::minmax(t[k], t[(k + 1) % 3])];
  }
  const auto is_rim = [&](std::uint32_t v) { return std::hypot(model.positions[v].x, model.positions[v].y) < 1.1F; };
  std::map<std::uint32_t, std::uint32_t> inside_of;
  const auto inside = [&](std::uint32_t v) {
    const auto [at, is_new] = inside_of.try_emplace(v, static_cast<std::uint32_t>(model.positions.size()));
    if (is_new)
      model.positions.push_back(glm::normalize(model.positions[v]) * static_cast<float>(0.9 * sculpted_radius));
    return at->second;
  };
  for (const auto& [edge, count] : triangles_at) {
    if (count != 1 || !is_rim(edge.first) || !is_rim(edge.second)) continue;
    model.triangles.push_back({edge.first, edge.second, inside(edge.second)});
    model.triangles.push_back({edge.first, inside(edge.second), inside(edge.first)});
  }
  std::vector<std::uint32_t> marked;
  for (const SurfacePoint& p : head.points) marked.push_back(head.surface.file_vertex_of[p.vertex.value()].value());
  head.surface = build_surface(model);
  for (std::size_t k = 0; k < marked.size(); ++k) head.points[k].vertex = head.surface.surface_of[marked[k]];
  const auto corner = std::max_element(inside_of.begin(), inside_of.end(), [&](const auto& a, const auto& b) {
    return model.positions[a.second].x < model.positions[b.second].x;
  });
  for (SurfacePoint& p : head.points) {
    if (p.id == parse_feature_point("3.7"))
      p = {p.id, head.surface.surface_of[corner->second], model.positions[corner->second]};
  }
  return head;
}

}  // namespace semblante::testing

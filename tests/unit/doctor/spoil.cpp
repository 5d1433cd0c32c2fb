#include "tests/unit/doctor/spoil.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

#include <glm/geometric.hpp>

#include "core/anatomy/part_roles.h"
#include "core/doctor/surface_way.h"
#include "core/geometry/edge_path_search.h"

namespace semblante::testing {
namespace {

glm::dvec3 middle_of(const Model& model, const Triangle& t) {
  return (glm::dvec3(model.positions[t[0]]) + glm::dvec3(model.positions[t[1]]) + glm::dvec3(model.positions[t[2]])) /
         3.0;
}

/// Points follow the vertices that they are on.
void refresh(Head& head) {
  for (FeaturePoint& p : head.points)
    if (p.vertex) p.position = head.model.positions[p.vertex->value()];
}

}  // namespace

FeaturePoint& point(Head& head, std::string_view name) {
  for (FeaturePoint& p : head.points)
    if (to_string(p.id) == name) return p;
  throw std::runtime_error(head.name + " has no point " + std::string(name));
}

std::uint32_t vertex(Head& head, std::string_view name) { return point(head, name).vertex->value(); }
glm::dvec3 place(Head& head, std::string_view name) { return point(head, name).position; }
double unit(Head& head) { return place(head, "3.5").x - place(head, "3.6").x; }

std::uint32_t skin_vertex_near(Head& head, const glm::dvec3& to) {
  const Surface surface = build_surface(head.model);
  const PartId skin = surface.part_of[surface.surface_of[vertex(head, "2.1")].value()];
  std::uint32_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (const SurfaceVertexId v : surface.members_of(skin)) {
    const double distance = glm::distance(surface.positions[v.value()], to);
    if (distance >= least) continue;
    least = distance;
    best = surface.file_vertex_of[v.value()].value();
  }
  return best;
}

std::uint32_t neighbor(const Head& head, std::uint32_t of) {
  const Surface surface = build_surface(head.model);
  const auto steps = surface.steps_from(surface.surface_of[of]);
  return surface.file_vertex_of[steps.front().to.value()].value();
}

std::uint32_t vertex_of_role(Head& head, std::vector<PartRole> roles, PartId* part) {
  const Surface surface = build_surface(head.model);
  const auto parts = describe_parts(head.model, surface, head.points);
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (std::find(roles.begin(), roles.end(), parts[p].role) == roles.end()) continue;
    *part = PartId(p);
    return surface.file_vertex_of[surface.members_of(PartId(p)).back().value()].value();
  }
  throw std::runtime_error(head.name + " has no such part");
}

void mark(Head& head, std::string_view name, std::uint32_t at) {
  FeaturePoint& p = point(head, name);
  p.vertex = VertexId(at);
  p.position = head.model.positions[at];
}

void unmark(Head& head, std::vector<std::string_view> names) {
  std::erase_if(head.points, [&](const FeaturePoint& p) {
    return std::find(names.begin(), names.end(), to_string(p.id)) != names.end();
  });
}

void exchange(Head& head, std::string_view a, std::string_view b) {
  std::swap(point(head, a).vertex, point(head, b).vertex);
  std::swap(point(head, a).position, point(head, b).position);
}

glm::dmat3 turn(int axis, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  glm::dmat3 m(1.0);
  const int a = (axis + 1) % 3;
  const int b = (axis + 2) % 3;
  m[a][a] = m[b][b] = std::cos(angle);
  m[a][b] = std::sin(angle);
  m[b][a] = -std::sin(angle);
  return m;
}

void transform(Head& head, const glm::dmat3& by) {
  for (glm::vec3& p : head.model.positions) p = glm::vec3(by * glm::dvec3(p));
  for (FeaturePoint& p : head.points) p.position = glm::vec3(by * glm::dvec3(p.position));
}

std::vector<std::uint32_t> triangles_near(const Head& head, const glm::dvec3& at, double radius) {
  std::vector<std::uint32_t> near;
  for (std::uint32_t t = 0; t < head.model.triangles.size(); ++t)
    if (glm::distance(middle_of(head.model, head.model.triangles[t]), at) < radius) near.push_back(t);
  return near;
}

void flip(Head& head, const std::vector<std::uint32_t>& triangles) {
  for (const std::uint32_t t : triangles) std::swap(head.model.triangles[t][1], head.model.triangles[t][2]);
}

void erase(Head& head, const std::vector<std::uint32_t>& triangles) {
  const std::set<std::uint32_t> gone(triangles.begin(), triangles.end());
  std::vector<Triangle> rest;
  std::vector<Primitive> primitives;
  for (const Primitive& primitive : head.model.primitives) {
    Primitive kept = primitive;
    kept.first_triangle = static_cast<std::uint32_t>(rest.size());
    for (std::uint32_t t = primitive.first_triangle; t < primitive.first_triangle + primitive.triangle_count; ++t)
      if (!gone.contains(t)) rest.push_back(head.model.triangles[t]);
    kept.triangle_count = static_cast<std::uint32_t>(rest.size()) - kept.first_triangle;
    primitives.push_back(kept);
  }
  head.model.triangles = std::move(rest);
  head.model.primitives = std::move(primitives);
}

void erase_parts(Head& head, std::vector<PartRole> roles) {
  const Surface surface = build_surface(head.model);
  const auto parts = describe_parts(head.model, surface, head.points);
  std::vector<std::uint32_t> gone;
  for (std::uint32_t t = 0; t < head.model.triangles.size(); ++t) {
    const PartRole role = parts[surface.part_of[surface.surface_of[head.model.triangles[t][0]].value()].value()].role;
    if (std::find(roles.begin(), roles.end(), role) != roles.end()) gone.push_back(t);
  }
  erase(head, gone);
}

void begin_primitive(Head& head, const std::string& name) {
  head.model.primitives.push_back({name, -1, static_cast<std::uint32_t>(head.model.triangles.size()), 0});
}

void copy_skin(Head& head, const glm::dmat3& scale, const glm::dvec3& by,
               const std::function<bool(const glm::dvec3&)>& wanted) {
  const Surface surface = build_surface(head.model);
  const PartId skin = surface.part_of[surface.surface_of[vertex(head, "2.1")].value()];
  std::map<SurfaceVertexId, std::uint32_t> copies;
  const std::size_t count = head.model.triangles.size();
  for (std::size_t t = 0; t < count; ++t) {
    Triangle triangle = head.model.triangles[t];
    if (surface.part_of[surface.surface_of[triangle[0]].value()] != skin || !wanted(middle_of(head.model, triangle)))
      continue;
    for (std::uint32_t& corner : triangle) {
      const auto [copy, is_new] = copies.try_emplace(surface.surface_of[corner], 0U);
      if (is_new) copy->second = add_vertex(head, scale * glm::dvec3(head.model.positions[corner]) + by);
      corner = copy->second;
    }
    add_triangle(head, triangle);
  }
}

void add_triangle(Head& head, const Triangle& triangle) {
  head.model.triangles.push_back(triangle);
  ++head.model.primitives.back().triangle_count;
}

std::uint32_t add_vertex(Head& head, const glm::dvec3& at) {
  head.model.positions.emplace_back(at);
  return static_cast<std::uint32_t>(head.model.positions.size() - 1);
}

void weld(Head& head, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
  const Surface surface = build_surface(head.model);
  std::map<SurfaceVertexId, std::uint32_t> becomes;
  for (const auto& [stays, goes] : pairs)
    if (surface.surface_of[goes] != surface.surface_of[stays]) becomes.emplace(surface.surface_of[goes], stays);
  for (Triangle& triangle : head.model.triangles) {
    for (std::uint32_t& corner : triangle) {
      const auto found = becomes.find(surface.surface_of[corner]);
      if (found != becomes.end()) corner = found->second;
    }
  }
}

void cut(Head& head, const std::function<bool(const glm::dvec3&)>& beyond, const glm::dvec3& by) {
  // On the surface: where a file has split its vertices already, both copies must go the same way.
  const Surface surface = build_surface(head.model);
  std::vector<bool> is_beyond(head.model.triangles.size());
  std::vector<bool> on_this_side(surface.vertex_count(), false);
  for (std::size_t t = 0; t < head.model.triangles.size(); ++t) {
    is_beyond[t] = beyond(middle_of(head.model, head.model.triangles[t]));
    if (is_beyond[t]) continue;
    for (const std::uint32_t corner : head.model.triangles[t]) on_this_side[surface.surface_of[corner].value()] = true;
  }
  std::map<std::uint32_t, std::uint32_t> copy_of;
  std::set<std::uint32_t> moved;
  for (std::size_t t = 0; t < head.model.triangles.size(); ++t) {
    if (!is_beyond[t]) continue;
    for (std::uint32_t& corner : head.model.triangles[t]) {
      if (on_this_side[surface.surface_of[corner].value()]) {
        const auto [copy, is_new] = copy_of.try_emplace(corner, 0U);
        if (is_new) copy->second = add_vertex(head, glm::dvec3(head.model.positions[corner]) + by);
        corner = copy->second;
      } else if (moved.insert(corner).second) {
        head.model.positions[corner] = glm::vec3(glm::dvec3(head.model.positions[corner]) + by);
      }
    }
  }
  refresh(head);
}

void subdivide(Head& head, std::vector<std::uint32_t> triangles, int times) {
  for (int round = 0; round < times; ++round) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto between = [&](std::uint32_t a, std::uint32_t b) {
      const auto [middle, is_new] = middles.try_emplace(std::minmax(a, b), 0U);
      if (is_new)
        middle->second =
            add_vertex(head, 0.5 * (glm::dvec3(head.model.positions[a]) + glm::dvec3(head.model.positions[b])));
      return middle->second;
    };
    std::vector<std::uint32_t> pieces;
    for (const std::uint32_t t : triangles) {
      const Triangle old = head.model.triangles[t];
      const std::uint32_t ab = between(old[0], old[1]);
      const std::uint32_t bc = between(old[1], old[2]);
      const std::uint32_t ca = between(old[2], old[0]);
      head.model.triangles[t] = {ab, bc, ca};
      pieces.push_back(t);
      for (const Triangle& corner : {Triangle{old[0], ab, ca}, Triangle{old[1], bc, ab}, Triangle{old[2], ca, bc}}) {
        pieces.push_back(static_cast<std::uint32_t>(head.model.triangles.size()));
        add_triangle(head, corner);
      }
    }
    triangles = std::move(pieces);
  }
}

std::vector<std::vector<std::uint32_t>> ways(Head& head, std::span<const Leg> legs) {
  const Surface surface = build_surface(head.model);
  EdgePathSearch search(surface);
  std::vector<std::vector<std::uint32_t>> list;
  for (const auto& [from, to] : legs) {
    const auto distances = search.from(surface.surface_of[vertex(head, from)]);
    auto& vertices = list.emplace_back();
    for (const SurfaceVertexId v : way_back(surface, distances, surface.surface_of[vertex(head, to)]))
      vertices.push_back(surface.file_vertex_of[v.value()].value());
  }
  return list;
}

}  // namespace semblante::testing

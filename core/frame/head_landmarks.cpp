#include "core/frame/head_landmarks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include <glm/geometric.hpp>

#include "core/anatomy/role_by_name.h"
#include "core/geometry/nearest_point.h"
#include "core/geometry/triangle_shape.h"

namespace semblante {
namespace {

std::vector<std::optional<PartRole>> roles_by_name(std::span<const PartShape> shapes) {
  std::vector<std::optional<PartRole>> roles(shapes.size());
  guess_roles_by_name(shapes, roles);
  return roles;
}

/// The two groups of a set of places along the axis of their largest extent; empty unless they form two groups on that
/// axis only.
std::optional<EyePair> two_groups(std::span<const glm::dvec3> centers) {
  if (centers.size() < 2) return std::nullopt;
  glm::dvec3 low = centers[0];
  glm::dvec3 high = centers[0];
  for (const glm::dvec3& center : centers) {
    low = glm::min(low, center);
    high = glm::max(high, center);
  }
  const glm::dvec3 extent = high - low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  std::array<glm::dvec3, 2> sum{glm::dvec3(0.0), glm::dvec3(0.0)};
  std::array<double, 2> count{};
  for (const glm::dvec3& center : centers) {
    const double place = extent[axis] > 0.0 ? (center[axis] - low[axis]) / extent[axis] : 0.5;
    if (place > 0.25 && place < 0.75) return std::nullopt;
    const std::size_t side = place < 0.5 ? 0 : 1;
    sum[side] += center;
    count[side] += 1.0;
  }
  const glm::dvec3 a = sum[0] / count[0];
  const glm::dvec3 b = sum[1] / count[1];
  const glm::dvec3 apart = glm::abs(b - a);
  for (int other = 0; other < 3; ++other) {
    if (other != axis && apart[other] > 0.2 * apart[axis]) return std::nullopt;
  }
  return EyePair{0.5 * (a + b), axis, glm::distance(a, b), false};
}

std::optional<EyePair> eyes_by_name(std::span<const PartShape> shapes) {
  const auto roles = roles_by_name(shapes);
  std::vector<glm::dvec3> centers;
  for (std::size_t p = 0; p < shapes.size(); ++p) {
    if (roles[p] == PartRole::left_eye || roles[p] == PartRole::right_eye) centers.push_back(shapes[p].box_center());
  }
  auto pair = two_groups(centers);
  if (pair) pair->by_name = true;
  return pair;
}

/// The two largest balls of equal size. Examines only a limited number of the largest, because a file may have hundreds
/// of thousands of equal balls.
std::optional<EyePair> eyes_by_shape(std::span<const PartShape> shapes) {
  constexpr std::size_t most_balls = 64;
  std::vector<const PartShape*> balls;
  for (const PartShape& shape : shapes) {
    if (shape.triangles > 0 && is_ball(shape)) balls.push_back(&shape);
  }
  std::stable_sort(balls.begin(), balls.end(),
                   [](const PartShape* a, const PartShape* b) { return a->sphere->radius > b->sphere->radius; });
  balls.resize(std::min(balls.size(), most_balls));
  std::optional<EyePair> best;
  double best_radius = 0.0;
  for (std::size_t p = 0; p < balls.size(); ++p) {
    for (std::size_t q = p + 1; q < balls.size(); ++q) {
      const Sphere& one = *balls[p]->sphere;
      const Sphere& other = *balls[q]->sphere;
      if (balls[q]->triangles != balls[p]->triangles) continue;
      if (std::abs(other.radius - one.radius) > 0.02 * one.radius || one.radius <= best_radius) continue;
      const auto pair = two_groups(std::array{one.center, other.center});
      // The distance between eyeballs is two to three diameters.
      if (!pair || pair->separation < 2.2 * one.radius || pair->separation > 12.0 * one.radius) continue;
      best = pair;
      best_radius = one.radius;
    }
  }
  return best;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The border edges of a part: edges of a single triangle.
std::vector<Edge> border_of(const Model& model, const Surface& surface, PartId part) {
  std::vector<Edge> edges;
  for (const Triangle& triangle : model.triangles) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) corners[c] = surface.surface_of[triangle[c]].value();
    if (surface.part_of[corners[0]] != part) continue;
    for (std::size_t c = 0; c < 3; ++c) edges.push_back(std::minmax(corners[c], corners[(c + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> border;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    if (end - i == 1) border.push_back(edges[i]);
    i = end;
  }
  return border;
}

struct Loop {
  double length = 0.0;
  glm::dvec3 low{1e300}, high{-1e300};
};

/// Joins border edges to loops.
std::vector<Loop> loops_of(std::span<const Edge> border, const Surface& surface) {
  std::map<std::uint32_t, std::uint32_t> parent;
  const auto root = [&parent](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [a, b] : border) {
    parent.try_emplace(a, a);
    parent.try_emplace(b, b);
    parent[root(a)] = root(b);
  }
  std::map<std::uint32_t, Loop> loops;
  for (const auto& [a, b] : border) {
    Loop& loop = loops[root(a)];
    loop.length += glm::distance(surface.positions[a], surface.positions[b]);
    for (const std::uint32_t v : {a, b}) {
      loop.low = glm::min(loop.low, surface.positions[v]);
      loop.high = glm::max(loop.high, surface.positions[v]);
    }
  }
  std::vector<Loop> list;
  list.reserve(loops.size());
  for (const auto& [v, loop] : loops) list.push_back(loop);
  return list;
}

}  // namespace

std::optional<EyePair> find_eyes(std::span<const PartShape> shapes) {
  if (auto eyes = eyes_by_name(shapes)) return eyes;
  return eyes_by_shape(shapes);
}

std::optional<glm::dvec3> find_mouth(std::span<const PartShape> shapes) {
  const auto roles = roles_by_name(shapes);
  glm::dvec3 low(1e300);
  glm::dvec3 high(-1e300);
  bool found = false;
  for (std::size_t p = 0; p < shapes.size(); ++p) {
    const bool is_tongue = roles[p] == PartRole::tongue;
    if (shapes[p].triangles == 0 || (!is_tongue && !is_named_teeth(shapes[p]))) continue;
    low = glm::min(low, shapes[p].low);
    high = glm::max(high, shapes[p].high);
    found = true;
  }
  return found ? std::optional(0.5 * (low + high)) : std::nullopt;
}

std::optional<NeckOpening> find_neck(const Model& model, const Surface& surface, PartId part) {
  const std::vector<Loop> loops = loops_of(border_of(model, surface, part), surface);
  const auto longest =
      std::max_element(loops.begin(), loops.end(), [](const Loop& a, const Loop& b) { return a.length < b.length; });
  if (longest == loops.end()) return std::nullopt;
  glm::dvec3 low(1e300);
  glm::dvec3 high(-1e300);
  for (const SurfaceVertexId v : surface.members_of(part)) {
    low = glm::min(low, surface.positions[v.value()]);
    high = glm::max(high, surface.positions[v.value()]);
  }
  const glm::dvec3 size = high - low;
  const glm::dvec3 extent = longest->high - longest->low;
  for (int axis = 0; axis < 3; ++axis) {
    const double across = std::min(extent[(axis + 1) % 3], extent[(axis + 2) % 3]);
    // A neck opening is flat and wide, unlike the hole of an eye.
    if (extent[axis] > 0.35 * across || across < 0.25 * std::min(size[(axis + 1) % 3], size[(axis + 2) % 3])) continue;
    const double at_low = longest->low[axis] - low[axis];
    const double at_high = high[axis] - longest->high[axis];
    if (std::min(at_low, at_high) >= 0.02 * size[axis]) continue;
    const double sign = at_low < at_high ? -1.0 : 1.0;
    // Open at both ends, as under a hat: which of them is the neck is not seen.
    const auto is_other_end = [&](const Loop& loop) {
      return loop.length > 0.5 * longest->length &&
             (sign < 0.0 ? high[axis] - loop.high[axis] : loop.low[axis] - low[axis]) < 0.1 * size[axis];
    };
    if (std::any_of(loops.begin(), loops.end(), is_other_end)) return std::nullopt;
    return NeckOpening{axis, sign};
  }
  return std::nullopt;
}

std::optional<int> find_mirror_axis(const PartShape& shape) {
  constexpr std::size_t samples = 1500;
  const std::vector<glm::dvec3>& points = shape.positions;
  if (points.size() < 30) return std::nullopt;
  NearestPoint nearest(points);
  const double size = glm::length(shape.extent());
  std::array<double, 3> error{};
  for (int axis = 0; axis < 3; ++axis) {
    error[static_cast<std::size_t>(axis)] = size;
    // With hair on one side the centre of the box is off the plane; the mean of the vertices may be closer to it.
    for (const double middle : {shape.box_center()[axis], shape.center[axis]}) {
      double sum = 0.0;
      const std::size_t step = std::max<std::size_t>(points.size() / samples, 1);
      std::size_t count = 0;
      for (std::size_t i = 0; i < points.size(); i += step, ++count) {
        glm::dvec3 mirrored = points[i];
        mirrored[axis] = 2.0 * middle - mirrored[axis];
        sum += nearest.nearest(mirrored).distance;
      }
      auto& least = error[static_cast<std::size_t>(axis)];
      least = std::min(least, sum / static_cast<double>(count));
    }
  }
  std::array<int, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return error[static_cast<std::size_t>(a)] < error[static_cast<std::size_t>(b)]; });
  const double best = error[static_cast<std::size_t>(order[0])];
  const double second = error[static_cast<std::size_t>(order[1])];
  if (best > 0.01 * size || best > 0.5 * second) return std::nullopt;
  return order[0];
}

double crowding(const Model& model, const Surface& surface, PartId part, const PartShape& shape, int axis) {
  double weighted = 0.0;
  double area = 0.0;
  for (const Triangle& triangle : model.triangles) {
    const std::uint32_t first = surface.surface_of[triangle[0]].value();
    if (surface.part_of[first] != part) continue;
    const glm::dvec3& a = surface.positions[first];
    const glm::dvec3& b = surface.positions[surface.surface_of[triangle[1]].value()];
    const glm::dvec3& c = surface.positions[surface.surface_of[triangle[2]].value()];
    const double size = glm::length(area_vector(a, b, c));
    weighted += size * (a[axis] + b[axis] + c[axis]) / 3.0;
    area += size;
  }
  const double extent = shape.extent()[axis];
  return area > 0.0 && extent > 0.0 ? (shape.center[axis] - weighted / area) / extent : 0.0;
}

}  // namespace semblante

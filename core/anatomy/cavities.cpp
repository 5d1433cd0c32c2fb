#include "core/anatomy/cavities.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <glm/geometric.hpp>

#include "core/anatomy/lip_edge.h"
#include "core/anatomy/rim_sides.h"
#include "core/anatomy/smooth_step.h"
#include "core/geometry/edge_path_search.h"
#include "core/geometry/shortest_path.h"
#include "core/tables/openings.h"

namespace semblante {
namespace {

const SurfacePoint* find_on_part(const Surface& surface, PartId part, std::span<const SurfacePoint> points,
                                 std::string_view name) {
  const auto id = parse_feature_point(name);
  const auto at = std::find_if(points.begin(), points.end(), [&](const SurfacePoint& p) {
    return p.id == id && surface.part_of[p.vertex.value()] == part;
  });
  return at != points.end() ? &*at : nullptr;
}

struct Corners {
  const SurfacePoint *first, *last;
};

/// Marks the vertices of one lip's or lid's rim, from corner to corner through its points. Whether it has one.
bool mark_rim(const Surface& surface, PartId part, std::span<const SurfacePoint> points, const Corners& corners,
              std::span<const std::string_view> names, std::vector<bool>& on_rim) {
  std::vector<const SurfacePoint*> line;
  for (const std::string_view name : names) {
    if (const SurfacePoint* const p = find_on_part(surface, part, points, name)) line.push_back(p);
  }
  if (line.empty()) return false;
  const glm::dvec3 across = corners.last->position - corners.first->position;
  std::sort(line.begin(), line.end(), [&](const SurfacePoint* a, const SurfacePoint* b) {
    return glm::dot(a->position, across) < glm::dot(b->position, across);
  });
  line.insert(line.begin(), corners.first);
  line.push_back(corners.last);
  for (std::size_t i = 1; i < line.size(); ++i) {
    for (const SurfaceVertexId v : shortest_path(surface, line[i - 1]->vertex, line[i]->vertex)) {
      on_rim[v.value()] = true;
    }
  }
  return true;
}

struct Rim {
  Cavity cavity;  ///< without members yet
  std::vector<bool> on_rim;
};

std::vector<Rim> find_rims(const Surface& surface, PartId part, std::span<const SurfacePoint> points) {
  std::vector<Rim> rims;
  for (const mpeg4::Opening& opening : mpeg4::openings) {
    const Corners corners{find_on_part(surface, part, points, opening.corners[0]),
                          find_on_part(surface, part, points, opening.corners[1])};
    if (corners.first == nullptr || corners.last == nullptr) continue;
    Rim rim;
    rim.cavity.is_mouth = opening.is_mouth;
    rim.cavity.middle = (corners.first->position + corners.last->position) / 2.0;
    rim.on_rim.assign(surface.vertex_count(), false);
    if (!mark_rim(surface, part, points, corners, opening.upper, rim.on_rim) ||
        !mark_rim(surface, part, points, corners, opening.lower, rim.on_rim)) {
      continue;
    }
    if (opening.is_mouth) {
      for (const SurfaceVertexId v : border_of_mouth(surface, points)) rim.on_rim[v.value()] = true;
    }
    rims.push_back(std::move(rim));
  }
  return rims;
}

/// Adds the unmarked vertices that paths join to those in `pending`, which are marked.
void flood(const Surface& surface, std::vector<SurfaceVertexId>& pending, std::vector<bool>& marked,
           std::vector<SurfaceVertexId>* reached = nullptr) {
  while (!pending.empty()) {
    const SurfaceVertexId at = pending.back();
    pending.pop_back();
    for (const Surface::Step& step : surface.steps_from(at)) {
      if (marked[step.to.value()]) continue;
      marked[step.to.value()] = true;
      pending.push_back(step.to);
      if (reached != nullptr) reached->push_back(step.to);
    }
  }
}

}  // namespace

std::vector<Cavity> find_cavities(const Surface& surface, PartId part, std::span<const SurfacePoint> points) {
  const std::vector<Rim> rims = find_rims(surface, part, points);
  if (rims.empty()) return {};
  std::vector<bool> marked(surface.vertex_count(), false);
  for (const Rim& rim : rims) {
    for (std::size_t v = 0; v < marked.size(); ++v) marked[v] = marked[v] || rim.on_rim[v];
  }
  std::vector<SurfaceVertexId> pending;
  for (const SurfacePoint& point : points) {
    if (surface.part_of[point.vertex.value()] != part || marked[point.vertex.value()]) continue;
    if (rim_of_point(point.id).opening != nullptr) continue;  // may be at a vertex on the wrong side of the rim
    marked[point.vertex.value()] = true;
    pending.push_back(point.vertex);
  }
  if (pending.empty()) return {};  // nothing tells the front from the back
  flood(surface, pending, marked);

  std::vector<Cavity> cavities;
  for (const Rim& rim : rims) {
    Cavity cavity = rim.cavity;
    for (const SurfaceVertexId v : surface.members_of(part)) {
      if (rim.on_rim[v.value()]) pending.push_back(v);
    }
    flood(surface, pending, marked, &cavity.members);
    std::sort(cavity.members.begin(), cavity.members.end());
    if (!cavity.members.empty()) cavities.push_back(std::move(cavity));
  }
  return cavities;
}

std::vector<bool> inside_of_mouth(const Surface& surface, std::span<const Part> parts,
                                  std::span<const SurfacePoint> points, double eye_separation) {
  constexpr double thickness_of_lip = 0.15;  // ES0
  std::vector<bool> inside;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (parts[p].role != PartRole::skin) continue;
    for (const Cavity& cavity : find_cavities(surface, PartId(p), points)) {
      if (!cavity.is_mouth) continue;
      const auto is_member = [&](SurfaceVertexId v) {
        return std::binary_search(cavity.members.begin(), cavity.members.end(), v);
      };
      std::vector<SurfaceVertexId> rim;
      for (const SurfaceVertexId v : cavity.members) {
        for (const Surface::Step& step : surface.steps_from(v)) {
          if (!is_member(step.to)) rim.push_back(step.to);
        }
      }
      EdgePathSearch search(surface);
      const auto from_rim = search.from(rim);
      inside.resize(surface.vertex_count(), false);
      for (const SurfaceVertexId v : cavity.members)
        inside[v.value()] = from_rim[v.value()] > thickness_of_lip * eye_separation;
    }
  }
  return inside;
}

double jaw_share_in_mouth(const glm::dvec3& from_corners) {
  constexpr double most = 0.85;
  constexpr double roof = 0.25;
  constexpr double floor = -0.35;
  constexpr double hinge = -1.3;
  constexpr double lips = -0.1;
  const double towards_lips = std::clamp((from_corners.z - hinge) / (lips - hinge), 0.0, 1.0);
  return most * towards_lips * (1.0 - smooth_step(floor, roof, from_corners.y));
}

}  // namespace semblante

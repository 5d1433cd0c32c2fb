#include "core/propose/face_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "core/anatomy/front_points.h"
#include "core/geometry/insert_vertices.h"
#include "core/geometry/triangle_shape.h"

namespace semblante {
namespace {

/// Penalty factor for the distance of a vertex from a plane on which it should be.
constexpr double off_plane = 3.0;
/// A vertex within this fraction of its edge length of the plane is on the plane.
constexpr double on_plane = 0.35;
/// A place nearer than this to another part may be taken for one of it.
constexpr double other_part = 0.02;

}  // namespace

FaceSurface::FaceSurface(const Surface& surface, std::span<const Part> parts, const Similarity& frame,
                         std::span<const Triangle> triangles)
    : surface_(surface), unit_(frame.scale) {
  places_.reserve(surface.vertex_count());
  for (const glm::dvec3& p : surface.positions) places_.push_back(frame(p));
  for (std::uint32_t v = 0; v < surface.vertex_count(); ++v) {
    if (surface.steps_from(SurfaceVertexId(v)).empty()) continue;
    by_role_[static_cast<std::size_t>(parts[surface.part_of[v].value()].role)].push_back(v);
  }
  if (triangles.empty()) return;
  for (const PartId part : surface.part_of) role_of_.push_back(parts[part.value()].role);
  corners_.assign(places_.begin(), places_.end());
  for (const Triangle& t : triangles) {
    Triangle& mapped = triangles_.emplace_back();
    std::transform(t.begin(), t.end(), mapped.begin(), [&](std::uint32_t v) { return surface.surface_of[v].value(); });
  }
  nearby_.emplace(corners_, triangles_);
  std::vector<glm::dvec3> normals(places_.size(), glm::dvec3(0.0));
  for (const Triangle& t : triangles_) {
    const glm::dvec3 normal = area_vector(places_[t[0]], places_[t[1]], places_[t[2]]);
    for (const std::uint32_t corner : t) normals[corner] += normal;
  }
  for (const glm::dvec3& normal : normals) faces_forward_.push_back(normal.z > faces_forward * glm::length(normal));
}

const std::vector<std::uint32_t>& FaceSurface::with_role(PartRole role) const {
  return by_role_[static_cast<std::size_t>(role)];
}

std::optional<std::uint32_t> FaceSurface::nearest(PartRole role, const glm::dvec3& place, const MirrorPlane* on,
                                                  const Filter& filter) const {
  std::optional<std::uint32_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t v : with_role(role)) {
    const glm::dvec3 away = places_[v] - place;
    double squared = glm::dot(away, away);
    if (squared >= least) continue;
    if (on != nullptr) {
      const double off = off_plane * on->distance(places_[v]);
      squared += off * off;
      if (squared >= least) continue;
    }
    if (filter && !filter(v)) continue;
    least = squared;
    best = v;
  }
  return best;
}

std::optional<glm::dvec3> FaceSurface::nearest_between(PartRole role, const glm::dvec3& place,
                                                       bool forward_only) const {
  if (!nearby_) return std::nullopt;
  const auto may_have_it = [&](std::uint32_t triangle) {
    const Triangle& t = triangles_[triangle];
    if (role_of_[t[0]] != role) return false;
    if (!forward_only) return true;
    const glm::dvec3 normal = area_vector(places_[t[0]], places_[t[1]], places_[t[2]]);
    return normal.z > faces_forward * glm::length(normal);
  };
  const TriangleTree::Hit hit = nearby_->nearest(place, may_have_it);
  if (!std::isfinite(hit.distance)) return std::nullopt;
  const Triangle& t = triangles_[hit.triangle];
  const glm::dvec3& a = places_[t[0]];
  const glm::dvec3& b = places_[t[1]];
  const glm::dvec3& c = places_[t[2]];
  if (meant_corner(hit.weights, a, b, c)) return std::nullopt;
  const glm::dvec3 shares = moved_to_edge(hit.weights);
  const glm::dvec3 between = shares.x * a + shares.y * b + shares.z * c;
  const TriangleTree::Hit other =
      nearby_->nearest(between, [&](std::uint32_t triangle) { return role_of_[triangles_[triangle][0]] != role; });
  return other.distance < other_part ? std::nullopt : std::optional(between);
}

std::uint32_t FaceSurface::climb(std::uint32_t start, const glm::dvec3& direction, double within,
                                 const MirrorPlane* on) const {
  std::uint32_t at = start;
  for (;;) {
    std::uint32_t best = at;
    const auto consider = [&](std::uint32_t v) {
      if (glm::distance(places_[v], places_[start]) > within) return;
      if (on != nullptr && !is_on(*on, v)) return;
      if (glm::dot(direction, places_[v]) > glm::dot(direction, places_[best])) best = v;
    };
    for (const Surface::Step& step : surface_.steps_from(SurfaceVertexId(at))) {
      consider(step.to.value());
      for (const Surface::Step& next : surface_.steps_from(step.to)) consider(next.to.value());
    }
    if (best == at) return at;
    at = best;
  }
}

std::optional<std::uint32_t> FaceSurface::farthest(PartRole role, const glm::dvec3& place, double within,
                                                   const glm::dvec3& direction, const MirrorPlane* on) const {
  std::optional<std::uint32_t> best;
  for (const std::uint32_t v : with_role(role)) {
    if (glm::distance(places_[v], place) > within) continue;
    if (best && glm::dot(direction, places_[v]) <= glm::dot(direction, places_[*best])) continue;
    if (on != nullptr && !is_on(*on, v)) continue;
    best = v;
  }
  return best;
}

double FaceSurface::spacing(std::uint32_t vertex) const {
  const auto steps = surface_.steps_from(SurfaceVertexId(vertex));
  double sum = 0.0;
  for (const Surface::Step& step : steps) sum += step.length;
  return steps.empty() ? 0.0 : unit_ * sum / static_cast<double>(steps.size());
}

bool FaceSurface::is_on(const MirrorPlane& plane, std::uint32_t vertex) const {
  return std::abs(plane.distance(places_[vertex])) <= on_plane * spacing(vertex);
}

}  // namespace semblante

#include "core/anatomy/pupil_hole.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/geometry/triangle_shape.h"

namespace semblante {
namespace {

constexpr double facing = 0.5;        // cosine: a front triangle's normal is within 60 degrees of the axis
constexpr double least_radius = 0.1;  // of a hole, in radii of the iris
constexpr double most_radius = 0.75;  // a larger hole is that of the whole iris
constexpr double most_offset = 0.5;   // of the centre from the axis, in radii of the iris
constexpr double roundness = 0.2;     // greatest deviation of a rim vertex, in radii of the hole
constexpr std::size_t least_vertices = 5;

using Edge = std::pair<SurfaceVertexId, SurfaceVertexId>;

/// The triangles at an edge.
struct AtEdge {
  int front_count = 0;
  SurfaceVertexId opposite{0};  ///< the third corner of a front triangle
};

struct Ring {
  glm::dvec3 middle{0.0};
  double radius = 0.0;
};

class HoleSearch {
 public:
  HoleSearch(const Surface& surface, const glm::dvec3& pivot, const glm::dvec3& axis)
      : surface_(surface), pivot_(pivot), axis_(axis) {}

  void add(const std::array<SurfaceVertexId, 3>& corners) {
    const glm::dvec3 normal = area_vector(at(corners[0]), at(corners[1]), at(corners[2]));
    const double size = glm::length(normal);
    if (!(size > 0.0) || glm::dot(normal, axis_) < facing * size) return;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(corners[i], corners[(i + 1) % 3]);
      AtEdge& edge = edges_[{a, b}];
      ++edge.front_count;
      edge.opposite = corners[(i + 2) % 3];
    }
  }

  /// The holes of the front, each a connected set of the edges where it ends.
  [[nodiscard]] std::vector<Ring> rings() const {
    std::map<SurfaceVertexId, std::vector<Edge>> ends_at;
    for (const auto& [edge, triangles] : edges_) {
      if (triangles.front_count != 1) continue;
      ends_at[edge.first].push_back(edge);
      ends_at[edge.second].push_back(edge);
    }
    std::vector<Ring> found;
    while (!ends_at.empty()) {
      std::vector<SurfaceVertexId> open = {ends_at.begin()->first};
      std::vector<SurfaceVertexId> vertices;
      std::vector<Edge> edges;
      while (!open.empty()) {
        const auto node = ends_at.extract(open.back());
        open.pop_back();
        if (node.empty()) continue;
        vertices.push_back(node.key());
        for (const Edge& edge : node.mapped()) {
          edges.push_back(edge);
          open.push_back(edge.first == node.key() ? edge.second : edge.first);
        }
      }
      if (const auto ring = ring_of(vertices, edges)) found.push_back(*ring);
    }
    return found;
  }

 private:
  [[nodiscard]] const glm::dvec3& at(SurfaceVertexId v) const { return surface_.positions[v.value()]; }

  [[nodiscard]] glm::dvec3 across(const glm::dvec3& d) const { return d - glm::dot(d, axis_) * axis_; }

  /// nullopt if the vertices are not on a circle about their mean, or the front is inside of it.
  [[nodiscard]] std::optional<Ring> ring_of(const std::vector<SurfaceVertexId>& vertices,
                                            const std::vector<Edge>& edges) const {
    if (vertices.size() < least_vertices) return std::nullopt;
    const auto count = static_cast<double>(vertices.size());
    Ring ring;
    for (const SurfaceVertexId v : vertices) ring.middle += at(v) / count;
    if (glm::dot(ring.middle - pivot_, axis_) <= 0.0) return std::nullopt;
    const auto distance = [&](const glm::dvec3& p) { return glm::length(across(p - ring.middle)); };
    for (const SurfaceVertexId v : vertices) ring.radius += distance(at(v)) / count;
    for (const SurfaceVertexId v : vertices) {
      if (std::abs(distance(at(v)) - ring.radius) > roundness * ring.radius) return std::nullopt;
    }
    const bool is_hole = std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) {
      const glm::dvec3 middle = 0.5 * (at(edge.first) + at(edge.second));
      return distance(at(edges_.at(edge).opposite)) > distance(middle);
    });
    return is_hole ? std::optional(ring) : std::nullopt;
  }

  const Surface& surface_;
  glm::dvec3 pivot_;
  glm::dvec3 axis_;
  std::map<Edge, AtEdge> edges_;
};

}  // namespace

std::optional<glm::dvec3> middle_of_pupil_hole(const Model& model, const Surface& surface, std::span<const Part> parts,
                                               PartRole role, const glm::dvec3& pivot, const glm::dvec3& axis,
                                               double iris_radius) {
  HoleSearch search(surface, pivot, axis);
  for (const Triangle& triangle : model.triangles) {
    std::array<SurfaceVertexId, 3> corners{SurfaceVertexId(0), SurfaceVertexId(0), SurfaceVertexId(0)};
    for (std::size_t i = 0; i < 3; ++i) corners[i] = surface.surface_of[triangle[i]];
    if (parts[surface.part_of[corners[0].value()].value()].role == role) search.add(corners);
  }
  std::optional<glm::dvec3> best;
  double nearest = most_offset * iris_radius;
  for (const Ring& ring : search.rings()) {
    if (ring.radius < least_radius * iris_radius || ring.radius > most_radius * iris_radius) continue;
    const glm::dvec3 d = ring.middle - pivot;
    const double offset = glm::length(d - glm::dot(d, axis) * axis);
    if (offset > nearest) continue;
    nearest = offset;
    best = ring.middle;
  }
  return best;
}

}  // namespace semblante

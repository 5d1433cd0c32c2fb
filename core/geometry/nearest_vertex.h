#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/geometry/nearest_point.h"
#include "core/geometry/surface.h"

namespace semblante {

/// Some vertices of a surface, and the nearest of them to a place.
class NearestVertex {
 public:
  struct Hit {
    SurfaceVertexId vertex;  ///< of vertices at equal distance the first that was given
    double distance;
  };

  /// `vertices` must not be empty.
  NearestVertex(const Surface& surface, std::vector<SurfaceVertexId> vertices)
      : vertices_(std::move(vertices)), nearest_(positions_of(surface, vertices_)) {}

  [[nodiscard]] Hit nearest(const glm::dvec3& place) {
    const NearestPoint::Hit hit = nearest_.nearest(place);
    return {vertices_[hit.index], hit.distance};
  }

 private:
  static std::vector<glm::dvec3> positions_of(const Surface& surface, std::span<const SurfaceVertexId> vertices) {
    std::vector<glm::dvec3> positions;
    positions.reserve(vertices.size());
    for (const SurfaceVertexId v : vertices) positions.push_back(surface.positions[v.value()]);
    return positions;
  }

  std::vector<SurfaceVertexId> vertices_;
  NearestPoint nearest_;
};

}  // namespace semblante

#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/anatomy/lid_edge.h"

namespace semblante {

/// The lines along the edges of the lids of an eye.
class EyeEdgeLines {
 public:
  /// `places`: of each surface vertex, in ES0.
  EyeEdgeLines(const EyeEdges& edges, std::span<const glm::dvec3> places);

  /// Whether a place lies on an edge.
  [[nodiscard]] bool has(const glm::dvec3& place) const;

 private:
  struct Segment {
    glm::dvec3 from, to;
  };
  std::vector<Segment> segments_;
};

}  // namespace semblante

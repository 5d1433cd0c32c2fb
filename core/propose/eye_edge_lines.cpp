#include "core/propose/eye_edge_lines.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace semblante {
namespace {

/// Maximum distance from the edge of a lid of what lies on it. Folds of real lids are 0.07 and more from it.
constexpr double on_edge = 0.02;

}  // namespace

EyeEdgeLines::EyeEdgeLines(const EyeEdges& edges, std::span<const glm::dvec3> places) {
  for (const LidEdge* const edge : {&edges.upper, &edges.lower}) {
    for (const auto& way : edge->to_corner)
      for (std::size_t k = 1; k < way.size(); ++k)
        segments_.push_back({places[way[k - 1].value()], places[way[k].value()]});
  }
}

bool EyeEdgeLines::has(const glm::dvec3& place) const {
  return std::any_of(segments_.begin(), segments_.end(), [&](const Segment& segment) {
    const glm::dvec3 way = segment.to - segment.from;
    const double square = glm::dot(way, way);
    const double share = square > 0.0 ? std::clamp(glm::dot(place - segment.from, way) / square, 0.0, 1.0) : 0.0;
    return glm::distance(place, segment.from + share * way) <= on_edge;
  });
}

}  // namespace semblante

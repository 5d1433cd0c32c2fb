#include "core/anatomy/rim_sides.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/geometric.hpp>

#include "core/geometry/edge_path_search.h"

namespace semblante {
namespace {

using Names = std::span<const std::string_view>;

bool holds(Names names, FeaturePointId id) {
  return std::any_of(names.begin(), names.end(),
                     [&](std::string_view name) { return parse_feature_point(name) == id; });
}

/// Distances from the nearest anchor of either list; empty where none is given.
std::vector<double> distances_from(EdgePathSearch& search, std::span<const SurfacePoint> anchors, Names flesh,
                                   Names beside) {
  std::vector<SurfaceVertexId> sources;
  for (const SurfacePoint& anchor : anchors) {
    if (holds(flesh, anchor.id) || holds(beside, anchor.id)) sources.push_back(anchor.vertex);
  }
  if (sources.empty()) return {};
  const auto distances = search.from(sources);
  return {distances.begin(), distances.end()};
}

}  // namespace

RimOfPoint rim_of_point(FeaturePointId id) {
  for (const mpeg4::Opening& opening : mpeg4::openings) {
    if (holds(opening.upper_flesh, id)) return {&opening, true};
    if (holds(opening.lower_flesh, id)) return {&opening, false};
  }
  return {};
}

RimSides::RimSides(const Surface& surface, const mpeg4::Opening& opening, std::span<const SurfacePoint> anchors)
    : surface_(surface) {
  EdgePathSearch search(surface);
  from_upper_ = distances_from(search, anchors, opening.upper_flesh, opening.above);
  from_lower_ = distances_from(search, anchors, opening.lower_flesh, opening.below);
  if (!have_anchors()) return;
  for (const SurfacePoint& anchor : anchors) {
    if (!holds(opening.corners, anchor.id) && !holds(opening.outer_corners, anchor.id)) continue;
    const double upper = from_upper_[anchor.vertex.value()];
    const double lower = from_lower_[anchor.vertex.value()];
    if (!std::isfinite(upper) || !std::isfinite(lower)) continue;
    corners_.push_back(anchor.position);
    upper_at_corner_.push_back(upper);
    lower_at_corner_.push_back(lower);
  }
}

double RimSides::side(SurfaceVertexId vertex) const {
  if (!have_anchors()) return 0.0;
  double upper = from_upper_[vertex.value()];
  double lower = from_lower_[vertex.value()];
  // Lips or lids that are separate parts.
  if (std::isinf(upper) || std::isinf(lower)) return std::isinf(upper) ? (std::isinf(lower) ? 0.0 : -1.0) : 1.0;
  double way_round = upper + lower;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const double away = glm::distance(surface_.positions[vertex.value()], corners_[c]);
    if (away >= nearest) continue;
    nearest = away;
    way_round = 2.0 * away;
    upper = from_upper_[vertex.value()] - upper_at_corner_[c];
    lower = from_lower_[vertex.value()] - lower_at_corner_[c];
  }
  return way_round > 0.0 ? std::clamp((lower - upper) / way_round, -1.0, 1.0) : 0.0;
}

}  // namespace semblante

#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/types/feature_point_id.h"
#include "core/types/triangle_place.h"

namespace semblante {

/// One marked point. With a vertex, it is at that surface vertex and moves it; without, it is only a position (7.1, a
/// pupil inside a triangle) for FAPUs and pivots and has no influence.
struct FeaturePoint {
  FeaturePointId id;
  std::optional<VertexId> vertex;
  glm::vec3 position{0.0F};  ///< model units, MPEG-4 frame
  /// Of a point between vertices that has no vertex yet: mark_head (core/pipeline) inserts one.
  std::optional<TrianglePlace> between = std::nullopt;
};

/// The marked points of one model, each id at most once, by increasing id.
using FeaturePointSet = std::vector<FeaturePoint>;

/// The marked point with this id, or null.
inline const FeaturePoint* find_point(const FeaturePointSet& points, FeaturePointId id) {
  const auto found = std::find_if(points.begin(), points.end(), [id](const FeaturePoint& p) { return p.id == id; });
  return found == points.end() ? nullptr : &*found;
}

}  // namespace semblante

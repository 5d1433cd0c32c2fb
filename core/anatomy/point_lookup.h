#pragma once

#include <span>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/geometry/surface.h"
#include "core/types/feature_points.h"

namespace semblante {

/// The marked point of that name ("2.1"), or null. `name` must be one of the 84.
const FeaturePoint* find_point(const FeaturePointSet& points, std::string_view name);

/// 3.5 and 3.6, which without a vertex are bare positions.
bool is_pupil(FeaturePointId id);

/// A marked point that moves the surface: one with a vertex.
struct SurfacePoint {
  FeaturePointId id;
  SurfaceVertexId vertex;
  glm::dvec3 position{0.0};  ///< of the vertex
};

/// The point with this name ("2.1"), or null. `name` must be one of the 84.
const SurfacePoint* point_named(std::span<const SurfacePoint> points, std::string_view name);

/// The points of the set that have a vertex, in rising order of id.
std::vector<SurfacePoint> surface_points(const Surface& surface, const FeaturePointSet& points);

}  // namespace semblante

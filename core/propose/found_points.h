#pragma once

#include <span>
#include <vector>

#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/model.h"
#include "core/types/result.h"
#include "core/types/rig.h"

namespace semblante {

/// A feature point that is found by the shape of a face, without marked points.
struct FoundPoint {
  FeaturePoint point;  ///< in the model's frame
  double noise = 0.0;  ///< standard deviation, in ES0
};

/// The points that are seen on an upright face with eyeballs: pupils, edges and corners of the eyes where the balls are
/// seen between the lids; edges and corners of the mouth where lips touch that are far from each other along the
/// surface; the tip of the nose. Rising by id, no two at one vertex. Points of eyes that are shut, and of lips that are
/// joined, are missing.
///
/// Errors: `missing` without two eyeballs, or if they are not side by side.
Result<std::vector<FoundPoint>> find_points_by_shape(const Surface& surface, std::span<const Part> parts,
                                                     std::span<const Triangle> triangles);

}  // namespace semblante

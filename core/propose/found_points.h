#pragma once

#include <span>
#include <vector>

#include "core/anatomy/reference_heads.h"
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

// Both functions turn a tilted face before they return: if the first points, or the relief, show that it does not look
// along +Z, the points are found again in the turned frame. Points rising by id, no two at one vertex.

/// The points that are seen on a face with eyeballs: pupils; edges and corners of the eyes where the balls are seen
/// between the lids; edges and corners of the mouth where lips touch that are far from each other along the surface;
/// the tip of the nose. Points of the lids of eyes that are shut, and of lips that are joined, are missing.
///
/// Errors: `missing` without two eyeballs, or if they are not roughly side by side.
Result<std::vector<FoundPoint>> find_points_by_eyeballs(const Surface& surface, std::span<const Part> parts,
                                                        std::span<const Triangle> triangles,
                                                        std::span<const ReferenceHead> references);

/// The points of a face that is found by its likeness to the reference heads (face_search.h), whatever its eyes are:
/// pupils as far as the likeness of the whole face shows them, mouth and tip of the nose as above; of lips that are
/// joined the outer edges, by the likeness too. Empty if nothing is like a face.
std::vector<FoundPoint> find_points_by_likeness(const Surface& surface, std::span<const Part> parts,
                                                std::span<const Triangle> triangles,
                                                std::span<const ReferenceHead> references);

}  // namespace semblante

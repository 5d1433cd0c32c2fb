#pragma once

#include <vector>

#include "server/api/vertex_positions.h"
#include "server/store/records.h"

namespace semblante::api {

/// Adds the missing partner of every marked point that has one on the other side: the vertex nearest to its mirror
/// image, within 5 % of the box diagonal, else none. A point of a lip or lid gets a vertex only if exactly one lies at
/// the image, else the image as its position: rims may touch, and place_feature_points distinguishes them along the
/// surface. The plane is x = the mean of the marked points in the middle (0 without any). Keeps `points` in rising
/// order.
void fill_by_mirror(std::vector<store::FeaturePointRecord>& points, const VertexPositions& positions);

}  // namespace semblante::api

#pragma once

#include <vector>

#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/weight_table.h"

namespace semblante {

/// Which surface vertices no level of detail may drop (#S flags):
///
/// - feature points;
/// - the borders of lips and eyelids: the shortest ways along edges between neighbouring marked points of the inner
///   (2.x) and outer (8.x) lip contours and of the lid edges (3.x);
/// - the rim of an opening of the mesh on which such a point lies: heads without a mouth bag or eye sockets end there;
/// - both ends of an edge across which the mover changes from upper to lower lip or lid: where lips or lids are joined
///   by a membrane, that line is all that parts them.
///
/// `influence` has one row a file vertex (Rig::influence).
std::vector<bool> fixed_vertices(const Surface& surface, const Model& model, const FeaturePointSet& points,
                                 const WeightTable<float>& influence);

}  // namespace semblante

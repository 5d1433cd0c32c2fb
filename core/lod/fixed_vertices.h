#pragma once

#include <vector>

#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/weight_table.h"

namespace semblante {

/// The surface vertices that all levels of detail keep (#S flags):
///
/// - feature points;
/// - the borders of lips and eyelids: the shortest paths along edges between neighbouring marked points of the inner
///   (2.x) and outer (8.x) lip contours and of the lid edges (3.x);
/// - the rim of an opening of the mesh with such a point: heads without a mouth bag or eye sockets end there;
/// - both ends of an edge whose ends follow different lips or lids (upper and lower): if a membrane joins lips or lids,
///   this line is their only separation.
///
/// `influence` has one row per file vertex (Rig::influence).
std::vector<bool> fixed_vertices(const Surface& surface, const Model& model, const FeaturePointSet& points,
                                 const WeightTable<float>& influence);

}  // namespace semblante

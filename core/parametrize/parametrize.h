#pragma once

#include <optional>
#include <vector>

#include "core/geometry/surface.h"
#include "core/parametrize/surface_weights.h"
#include "core/types/feature_points.h"
#include "core/types/model.h"
#include "core/types/result.h"
#include "core/types/rig.h"

namespace semblante {

struct ParametrizeOptions {
  /// By PartId; empty entries (and a vector too short) leave the role to the guess.
  std::vector<std::optional<PartRole>> roles_by_user;
  /// Units given by hand, in model units, already divided by 1024; they replace what the points give.
  Fapu fapu_by_user;
  WeightMethod weights = WeightMethod::paper;
  DistanceMetric metric = DistanceMetric::edge;
  Progress progress;
};

/// FAPUs, regions and weights (Eq. 1 to 4) of one model, and Eq. 7's quotient with the roles of parts applied.
/// `surface` must be build_surface(model), `points` the result of place_feature_points on them. Fails with `empty`
/// for a model without triangles and with `cancelled`; what is merely missing becomes a warning of the rig.
Result<Rig> parametrize(const Model& model, const Surface& surface, const FeaturePointSet& points,
                        const ParametrizeOptions& options = {});

}  // namespace semblante

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
  /// By PartId; for empty entries (and a short vector) the role is guessed.
  std::vector<std::optional<PartRole>> roles_by_user;
  /// Units given by hand, in model units, already divided by 1024; they replace those computed from the points.
  Fapu fapu_by_user;
  WeightMethod weights = WeightMethod::paper;
  DistanceMetric metric = DistanceMetric::edge;
  Progress progress;
};

/// FAPUs, regions and weights (Eq. 1 to 4) of one model, and Eq. 7's quotient after applying the roles of parts.
/// `surface` must be build_surface(model), `points` the result of place_feature_points on them. Fails with `empty` for
/// a model without triangles, with `missing` at "/weights" for `fitted` weights of a model without shapes of its own,
/// and with `cancelled`; missing data become warnings of the rig.
Result<Rig> parametrize(const Model& model, const Surface& surface, const FeaturePointSet& points,
                        const ParametrizeOptions& options = {});

}  // namespace semblante

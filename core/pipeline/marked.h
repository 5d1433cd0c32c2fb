#pragma once

#include <optional>
#include <vector>

#include "core/doctor/finding.h"
#include "core/pipeline/standing.h"
#include "core/types/feature_points.h"
#include "core/types/rig.h"

namespace semblante {

/// Stage 3: the feature points placed on the head, which stands as they show.
struct MarkedHead : StandingHead {
  FeaturePointSet points;
  std::vector<std::optional<PartRole>> roles_by_user;  ///< by PartId
  std::vector<Finding> refused;                        ///< points left out, see MarkRequest::leaves_out_refused
  std::optional<glm::dmat3> turn;  ///< from the StandingHead to this one; empty: the points did not turn it
};

struct MarkRequest {
  std::vector<MarkedPoint> points;                     ///< positions as the StandingHead stands
  std::vector<std::optional<PartRole>> roles_by_user;  ///< by PartId; empty entries leave the role to the guess
  /// A point that cannot be placed becomes a finding instead of an error.
  bool leaves_out_refused = false;
};

/// Places the points. Where they show that the head stands otherwise, and the user has not said how, it is turned and
/// they are placed again. Errors: those of place_feature_points; `cancelled`.
Result<MarkedHead> mark_head(StandingHead head, MarkRequest request, const Progress& progress = {});

}  // namespace semblante

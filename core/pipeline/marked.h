#pragma once

#include <optional>
#include <vector>

#include "core/doctor/finding.h"
#include "core/pipeline/standing.h"
#include "core/types/fapu.h"
#include "core/types/feature_points.h"
#include "core/types/rig.h"

namespace semblante {

/// Stage 3: the head with its feature points, rotated to the axes that the points show.
struct MarkedHead : StandingHead {
  FeaturePointSet points;
  std::vector<std::optional<PartRole>> roles_by_user;  ///< by PartId
  Fapu fapu_by_user;                                   ///< units given by hand
  std::vector<Finding> refused;                        ///< omitted points, see MarkRequest::leaves_out_refused
  std::optional<glm::dmat3>
      turn;  ///< rotation from the StandingHead to this head; empty: the points did not change the axes
};

struct MarkRequest {
  std::vector<MarkedPoint> points;                     ///< positions in the axes of the StandingHead
  std::vector<std::optional<PartRole>> roles_by_user;  ///< by PartId; empty entries leave the role to the guess
  /// A point that cannot be placed becomes a finding instead of an error.
  bool leaves_out_refused = false;
  Fapu fapu_by_user = {};  ///< units given by hand; empty ones are measured
};

/// Places the points. If they show other axes, and the user has not set the axes, rotates the head and places the
/// points again. Errors: those of place_feature_points; `cancelled`.
Result<MarkedHead> mark_head(StandingHead head, MarkRequest request, const Progress& progress = {});

}  // namespace semblante

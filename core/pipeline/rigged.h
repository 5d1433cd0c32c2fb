#pragma once

#include "core/parametrize/weight_method.h"
#include "core/pipeline/marked.h"
#include "core/types/articulation.h"

namespace semblante {

/// Stage 4: the parametrized head (Eq. 1 to 4). model.to_file_frame transforms back to the file's axes
/// and unit.
struct RiggedHead : MarkedHead {
  Rig rig;
};

struct RigRequest {
  WeightMethod weights = WeightMethod::paper;
  DistanceMetric metric = DistanceMetric::edge;
  /// least_articulation to most_articulation.
  double articulation = usual_articulation;
};

/// Errors: those of parametrize.
Result<RiggedHead> rig_head(MarkedHead head, const RigRequest& request, const Progress& progress = {});

}  // namespace semblante

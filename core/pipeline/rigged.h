#pragma once

#include "core/parametrize/weight_method.h"
#include "core/pipeline/marked.h"

namespace semblante {

/// Stage 4: the head with everything that is computed once about it (Eq. 1 to 4). model.to_file_frame leads back to the
/// file's axes.
struct RiggedHead : MarkedHead {
  Rig rig;
};

struct RigRequest {
  WeightMethod weights = WeightMethod::paper;
  DistanceMetric metric = DistanceMetric::edge;
};

/// Errors: those of parametrize.
Result<RiggedHead> rig_head(MarkedHead head, const RigRequest& request, const Progress& progress = {});

}  // namespace semblante

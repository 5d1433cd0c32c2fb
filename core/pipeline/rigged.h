#pragma once

#include <optional>
#include <string>

#include "core/parametrize/weight_method.h"
#include "core/pipeline/marked.h"
#include "core/types/articulation.h"

namespace semblante {

/// Stage 4: the parametrized head (Eq. 1 to 4). model.to_file_frame transforms back to the file's axes
/// and unit.
struct RiggedHead : MarkedHead {
  Rig rig;
  std::string articulation_reason;  ///< where rig.articulation comes from, as a sentence
};

struct RigRequest {
  WeightMethod weights = WeightMethod::paper;
  DistanceMetric metric = DistanceMetric::edge;
  /// least_articulation to most_articulation. Empty: that of the head's own shapes (own_articulation), or the usual
  /// one if they show none.
  std::optional<double> articulation = std::nullopt;
};

/// Errors: those of parametrize.
Result<RiggedHead> rig_head(MarkedHead head, const RigRequest& request, const Progress& progress = {});

}  // namespace semblante

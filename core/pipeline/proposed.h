#pragma once

#include "core/pipeline/marked.h"
#include "core/propose/propose.h"
#include "core/types/result.h"

namespace semblante {

/// The points that are missing on a marked head: propose_feature_points with all that the head's file tells. Errors: as
/// there.
Result<Proposals> propose_points(const MarkedHead& head);

}  // namespace semblante

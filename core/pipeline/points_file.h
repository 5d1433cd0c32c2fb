#pragma once

#include "core/import/feature_points_file.h"
#include "core/pipeline/marked.h"

namespace semblante {

/// Stages 2 and 3 for a head with a feature point file, whose positions are in the axes of the model file.
/// `leaves_out_refused` as in MarkRequest. Errors: `invalid_argument` at "/to_mpeg4_axes" if both the file and `wish`
/// set the axes; those of mark_head.
Result<MarkedHead> mark_by_file(ImportedHead head, FeaturePointsFile file, const FrameWish& wish = {},
                                bool leaves_out_refused = false, const Progress& progress = {});

}  // namespace semblante

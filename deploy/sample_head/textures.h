#pragma once

#include "deploy/sample_head/half_mesh.h"
#include "deploy/sample_head/sample_head.h"

namespace semblante::sample_head_detail {

/// The skin's colours, painted by position: a warm base, flush of cheeks, nose and ears, the red of the lips, shade
/// under the hair. Symmetric.
SampleHeadImage paint_skin(const HalfMesh& skin);

/// An eyeball seen from the front: sclera, iris with fibres and a dark rim, pupil (`pupil_of_iris`).
SampleHeadImage paint_eye();

/// Strands from top to bottom, for hair combed along v.
SampleHeadImage paint_hair();

/// A gradient from gum (top) to tooth (bottom).
SampleHeadImage paint_teeth();

}  // namespace semblante::sample_head_detail

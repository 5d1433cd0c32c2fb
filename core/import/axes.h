#pragma once

#include <glm/mat3x3.hpp>

#include "core/import/feature_points_file.h"
#include "core/types/model.h"

namespace semblante {

/// Transforms a model to MPEG-4 axes: positions and normals by `to_mpeg4` (which must be invertible), and reverses the
/// winding if it mirrors; updates to_file_frame. The identity changes no bit.
void change_axes(Model& model, const glm::dmat3& to_mpeg4);

/// Transforms the marked positions of a file by its own to_mpeg4_axes, if present.
void change_axes(FeaturePointsFile& file);

}  // namespace semblante

#pragma once

#include <glm/mat3x3.hpp>

#include "core/import/feature_points_file.h"
#include "core/types/model.h"

namespace semblante {

/// Turns a model into the MPEG-4 frame: positions and normals by `to_mpeg4` (which must have an inverse), windings too
/// where it mirrors; to_file_frame then leads back. The identity leaves every bit as it was.
void change_axes(Model& model, const glm::dmat3& to_mpeg4);

/// The marked positions of a file by its own to_mpeg4_axes; nothing if it has none.
void change_axes(FeaturePointsFile& file);

}  // namespace semblante

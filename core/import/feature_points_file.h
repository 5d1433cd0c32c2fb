#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>

#include "core/types/fapu.h"
#include "core/types/marked_point.h"
#include "core/types/result.h"

namespace semblante {

/// A feature point file: {"points": {"2.1": {"vertex": 966, "position": [x, y, z]}, ...}}. Each point has a vertex
/// (from 0, in the model file's own numbering), a position in the model file's own space, or both; `null` counts as
/// absent. A position alone may lie anywhere on the surface, also between vertices; with a vertex, it only says whether
/// the numbers are those of this file. Unknown members are ignored. "proposed": true marks a point that no person has
/// placed or confirmed.
struct FeaturePointsFile {
  std::vector<MarkedPoint> points;  ///< in rising order of id; positions still in the FILE's axes
  /// "to_mpeg4_axes", rows as written: MPEG-4 position = matrix * file position. See axes.h.
  std::optional<glm::dmat3> to_mpeg4_axes;
  Fapu fapu_by_user;  ///< units given by hand: not from the file, for the stage that places the points
};

/// Parses strictly; error.where is a JSON pointer such as "/points/2.1/vertex", or a byte offset for invalid JSON.
/// place_feature_points checks that the vertices exist in a model.
Result<FeaturePointsFile> parse_feature_points(std::string_view json);

}  // namespace semblante

#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>

#include "core/types/marked_point.h"
#include "core/types/result.h"

namespace semblante {

/// What a feature point file says: {"points": {"2.1": {"vertex": 966, "position": [x, y, z]}, ...}}. Each point has a
/// vertex (from 0, in the model file's own numbering), a position in the model file's own space, or both; `null` counts
/// as absent, and so do members we do not know. "proposed": true marks a point that nobody has placed or confirmed.
struct FeaturePointsFile {
  std::vector<MarkedPoint> points;  ///< in rising order of id; positions still in the FILE's axes
  /// "to_mpeg4_axes", rows as written: MPEG-4 position = matrix * file position. See axes.h.
  std::optional<glm::dmat3> to_mpeg4_axes;
};

/// Parses strictly; error.where is a JSON pointer such as "/points/2.1/vertex", or a byte where it is no JSON at all.
/// That vertices exist in a model is for place_feature_points to check.
Result<FeaturePointsFile> parse_feature_points(std::string_view json);

}  // namespace semblante

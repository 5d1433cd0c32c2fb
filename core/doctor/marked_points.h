#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/doctor/finding.h"
#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/marked_point.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// The marked points that can be placed, and a finding for each that cannot.
struct PlacedPoints {
  FeaturePointSet points;
  std::vector<Finding> refused;
  std::vector<std::string> warnings;  ///< of place_feature_points
};

/// Like place_feature_points, but reports all errors: instead of stopping at the first refused point, omits the point
/// and continues.
PlacedPoints place_what_can_be(const Model& model, const Surface& surface, std::vector<MarkedPoint> marked,
                               std::span<const std::optional<PartRole>> roles_by_user = {});

}  // namespace semblante

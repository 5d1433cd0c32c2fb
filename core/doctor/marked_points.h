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

/// As many of the marked points as can be placed, and a finding for each that cannot.
struct PlacedPoints {
  FeaturePointSet points;
  std::vector<Finding> refused;
  std::vector<std::string> warnings;  ///< of place_feature_points
};

/// place_feature_points for someone who wants to know everything that is wrong at once: where that stops at the first
/// point it refuses, this leaves the point out and goes on.
PlacedPoints place_what_can_be(const Model& model, const Surface& surface, std::vector<MarkedPoint> marked,
                               std::span<const std::optional<PartRole>> roles_by_user = {});

}  // namespace semblante

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/doctor/finding.h"
#include "tests/unit/doctor/heads.h"

namespace semblante::testing {

/// Where a planted defect must be found; what is empty is not asked.
struct Expected {
  std::vector<FeaturePointId> points;  ///< among those of the finding
  std::optional<glm::dvec3> near;      ///< its position or one of its vertices is within a quarter of ES0
  std::optional<PartId> part;
  std::string says = {};  ///< within its words
};

/// A fault and how it is planted into a good head.
struct Defect {
  std::string name;
  FindingCode code;
  std::function<std::optional<Expected>(Head&)> plant;  ///< empty: this head has no room for it
  bool needs_weights = false;                           ///< is found by smooth weights alone
};

/// Every defect that the doctor claims to find.
const std::vector<Defect>& defects();

}  // namespace semblante::testing

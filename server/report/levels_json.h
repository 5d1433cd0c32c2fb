#pragma once

#include <span>

#include <nlohmann/json_fwd.hpp>

#include "core/lod/decimate.h"
#include "core/lod/level_error.h"
#include "core/lod/missed_budgets.h"

namespace semblante {

/// The member `levels_of_detail` of the report document (its form is in ../api/openapi.json, `LevelsOfDetail`): each
/// level's distances from the full mesh, in model units and as fractions of `eye_separation` (ES0; 0 where unknown), at
/// rest and in the poses by name. `errors` are by level.
nlohmann::ordered_json levels_of_detail_json(std::span<const LevelOfDetail> levels, std::span<const LevelError> errors,
                                             std::span<const LodPose> poses, double eye_separation,
                                             std::span<const MissedBudget> missed);

}  // namespace semblante

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/lod/decimate.h"
#include "core/lod/level_error.h"

namespace semblante {

/// A level that was asked for and is not there, or not as small as asked.
struct MissedBudget {
  std::uint32_t budget = 0;
  std::string words;
};

/// Which of `budgets` the levels do not keep, and why.
std::vector<MissedBudget> missed_budgets(std::span<const std::uint32_t> budgets, std::span<const LevelOfDetail> levels);

/// The member `levels_of_detail` of the report document (its form is in ../api/openapi.json, `LevelsOfDetail`): each
/// level's distances from the full mesh, in model units and as shares of `eye_separation` (ES0; 0 where unknown), at
/// rest and in the poses by name. `errors` are by level.
std::string write_levels_of_detail(std::span<const LevelOfDetail> levels, std::span<const LevelError> errors,
                                   std::span<const LodPose> poses, double eye_separation,
                                   std::span<const MissedBudget> missed);

}  // namespace semblante

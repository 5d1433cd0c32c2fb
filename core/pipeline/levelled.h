#pragma once

#include <cstdint>
#include <vector>

#include "core/lod/decimate.h"
#include "core/lod/level_error.h"
#include "core/lod/missed_budgets.h"
#include "core/materials/materials.h"
#include "core/pipeline/rigged.h"

namespace semblante {

/// Stage 5: the head with its materials and its levels of detail: the input of a face package.
struct LevelledHead : RiggedHead {
  MaterialAssignment materials;
  std::vector<LevelOfDetail> levels;  ///< by decreasing size; none without budgets
  std::vector<LodPose> poses;         ///< the faces in which the error of a level is measured; none without budgets
  std::vector<MissedBudget> missed;
};

/// `budgets` as LodOptions::budgets; may be empty. Errors: `cancelled`.
Result<LevelledHead> level_head(RiggedHead head, std::vector<std::uint32_t> budgets, const Progress& progress = {});

/// Measures the error of each level against the full mesh, for a report. Error: `cancelled`.
Result<std::vector<LevelError>> measure_levels(const LevelledHead& head, const Progress& progress = {});

}  // namespace semblante

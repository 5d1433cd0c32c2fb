#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/lod/decimate.h"

namespace semblante {

/// A requested level that is missing or larger than requested.
struct MissedBudget {
  std::uint32_t budget = 0;
  std::string words;
};

/// The budgets that the levels do not meet, with reasons.
std::vector<MissedBudget> missed_budgets(std::span<const std::uint32_t> budgets, std::span<const LevelOfDetail> levels);

}  // namespace semblante

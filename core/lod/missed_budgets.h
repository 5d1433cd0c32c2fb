#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/lod/decimate.h"

namespace semblante {

/// A level that was asked for and is not there, or not as small as asked.
struct MissedBudget {
  std::uint32_t budget = 0;
  std::string words;
};

/// Which of `budgets` the levels do not keep, and why.
std::vector<MissedBudget> missed_budgets(std::span<const std::uint32_t> budgets, std::span<const LevelOfDetail> levels);

}  // namespace semblante

#include "core/lod/missed_budgets.h"

#include <algorithm>

namespace semblante {

std::vector<MissedBudget> missed_budgets(std::span<const std::uint32_t> budgets,
                                         std::span<const LevelOfDetail> levels) {
  std::vector<MissedBudget> missed;
  for (const std::uint32_t budget : budgets) {
    const auto level = std::find_if(levels.begin(), levels.end(), [&](const auto& l) { return l.budget == budget; });
    if (level == levels.end()) {
      missed.push_back({budget, "there is no level of " + std::to_string(budget) +
                                    " vertices: it would not be smaller than the one before by a tenth, because the "
                                    "model has no more or feature points, lips, lids, borders and seams must stay"});
    } else if (level->vertex_count > budget) {
      missed.push_back({budget, "the level of " + std::to_string(budget) + " vertices has " +
                                    std::to_string(level->vertex_count) +
                                    ": feature points, lips, lids, borders and seams must stay"});
    }
  }
  return missed;
}

}  // namespace semblante

#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "tests/bench/weights/expression_study.h"

namespace semblante::bench {

/// Where on a head an error lies.
inline constexpr std::array<std::string_view, 9> region_names = {"lips", "chin", "lids",  "brows",  "cheeks",
                                                                 "nose", "rest", "mouth", "sockets"};
using ByRegion = std::array<double, region_names.size()>;

/// What each region adds to Figures::error: the sum is that error. A visible vertex belongs to the region of the
/// nearest point of the skin; `rest` is ears, neck and scalp; `mouth` and `sockets` are hidden.
ByRegion error_by_region(const ExpressionStudy& study, const Shares& shares);
/// The share of each region in the squared displacements, mean of the expressions.
ByRegion motion_by_region(const ExpressionStudy& study);

/// The least error of Eq. 7 that `most` influences a vertex can have: per vertex the non-negative weights with a sum of
/// at most one that fit the study's own expressions best; of more than `most` the greatest are kept and fitted again.
Shares best_shares(const ExpressionStudy& study, std::size_t most);

}  // namespace semblante::bench

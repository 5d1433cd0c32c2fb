#pragma once

#include <cstddef>

#include "core/parametrize/weight_row.h"
#include "core/types/weight_table.h"

namespace semblante {

/// The most points that may share a vertex where rows are shares.
inline constexpr std::size_t max_smooth_influences = 8;
/// A weight below this has no visible effect and would only take space in the table.
inline constexpr double least_weight = 1e-4;

/// Keeps the `max_smooth_influences` greatest weights and their sum. The greatest dropped weight is subtracted from all
/// of them, so that a weight is zero when it is dropped. If that would leave almost nothing (many points equally far)
/// no choice is continuous: then the greatest are kept unchanged, among equal ones those of lower ids.
void keep_greatest(WeightRow& weights);

/// Ends the table with a row of these weights, without those below `least_weight`.
void push_row(WeightTable<double>& table, const WeightRow& weights);

}  // namespace semblante

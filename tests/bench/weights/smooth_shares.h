#pragma once

#include "core/parametrize/weight_prior.h"
#include "core/types/weight_table.h"
#include "tests/bench/weights/expression_study.h"

namespace semblante::bench {

/// Smooth weights of a head's skin as shares.
Shares smooth_shares(const ExpressionStudy& study, const WeightPrior& prior);

/// The shares of a table of shares: #M rows.
Shares shares_of_table(const ExpressionStudy& study, const WeightTable<double>& table);

}  // namespace semblante::bench

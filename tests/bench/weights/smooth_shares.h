#pragma once

#include "core/parametrize/weight_prior.h"
#include "tests/bench/weights/expression_study.h"

namespace semblante::bench {

/// Smooth weights of a head's skin as shares.
Shares smooth_shares(const ExpressionStudy& study, const WeightPrior& prior);

}  // namespace semblante::bench

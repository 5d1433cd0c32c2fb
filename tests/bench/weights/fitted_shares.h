#pragma once

#include "core/parametrize/weight_prior.h"
#include "core/types/weight_fit.h"
#include "tests/bench/weights/expression_study.h"

namespace semblante::bench {

/// Weights fitted to shapes, and their leave-one-out errors.
struct FittedShares {
  Shares shares;
  WeightFit fit;
};

/// The weights of `WeightMethod::fitted` of the study's head, fitted to the expressions of `teacher`, a study of the
/// same head. Leave-one-out errors are of all vertices if there are few expressions, as in the product.
FittedShares fitted_shares(const ExpressionStudy& study, const ExpressionStudy& teacher, const WeightPrior& prior);

}  // namespace semblante::bench

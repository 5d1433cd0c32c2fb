#pragma once

#include "tests/bench/weights/expression_study.h"

namespace semblante::bench {

/// Plain methods of the field, to compare ours with. They use every point at every vertex.
Shares harmonic_shares(const ExpressionStudy& study);    ///< least Dirichlet energy, cotangent Laplacian
Shares linear_rbf_shares(const ExpressionStudy& study);  ///< |r| with a linear polynomial
/// exp(-r / (length ES0)), sums free; `length` 0.3 to 0.7 is what others use.
Shares kriging_shares(const ExpressionStudy& study, double length);

}  // namespace semblante::bench

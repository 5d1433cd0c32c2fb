#pragma once

#include <span>
#include <vector>

#include "core/parametrize/weight_prior.h"
#include "tests/bench/prior/training_head.h"

namespace semblante::bench {

/// The table that makes the smooth weights of these heads closest to their expressions: least squares of the skin
/// outside mouth and sockets, as WeightPrior computes it, with a ridge on the table and
/// one on the roughness of what it adds. Each row stands for its mirror image as well.
std::vector<WeightPrior::Entry> train_prior(std::span<const TrainingHead> heads);

}  // namespace semblante::bench

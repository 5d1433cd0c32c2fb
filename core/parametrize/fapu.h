#pragma once

#include <string>
#include <vector>

#include "core/types/fapu.h"
#include "core/types/feature_points.h"

namespace semblante {

/// FAPUs of a neutral face, in model units, already divided by 1024:
///
///     IRISD  mean of 3.1.y - 3.3.y (left eye) and 3.2.y - 3.4.y (right); one eye alone is enough
///     ES     3.5.x - 3.6.x
///     ENS    3.5.y - 9.15.y
///     MNS    9.15.y - 2.2.y
///     MW     8.3.x - 8.4.x
///
/// A unit whose points are missing, or whose points are swapped so that it would not be positive, stays empty.
Fapu compute_fapu(const FeaturePointSet& points);

/// One sentence for each unit that `compute_fapu` leaves empty: its name, why, and what does not work without it.
/// `fapu` may have been completed by hand; only units still empty are explained.
std::vector<std::string> explain_missing_fapu(const Fapu& fapu, const FeaturePointSet& points);

}  // namespace semblante

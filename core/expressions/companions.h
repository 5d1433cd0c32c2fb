#pragma once

#include <span>
#include <vector>

#include "core/kernel/semblante_kernel.h"
#include "core/types/companion.h"
#include "core/types/feature_points.h"

namespace semblante {

/// The folds of upper lids (3.13, 3.14) that go along with a near brow (4.3, 4.4). The share grows from zero, where the
/// brow is half an eye's width above the fold, so that the skin between them is squeezed no more than there; at most
/// that which squeezes the lid below the fold as much.
std::vector<Companion> folds_below_near_brows(const FeaturePointSet& points);

/// The entries of the table of companions (core/tables/data/companions.json) whose two points are marked, and the folds
/// below near brows.
std::vector<Companion> companions_of(const FeaturePointSet& points);

/// For semblante_rig.companion.
std::vector<semblante_companion> to_kernel(std::span<const Companion> companions);

}  // namespace semblante

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

/// The cheeks (5.1, 5.2) that go along with a near corner of the mouth (8.3, 8.4). The share grows from zero, where the
/// corner is a third of the mouth's width away, so that the skin between them is stretched and squeezed no more than
/// there.
std::vector<Companion> cheeks_beside_near_corners(const FeaturePointSet& points);

/// The entries of the table of companions (core/tables/data/companions.json) whose two points are marked, the folds
/// below near brows, and the cheeks beside near corners: these follow by their share what the table leaves.
std::vector<Companion> companions_of(const FeaturePointSet& points);

/// For semblante_rig.companion.
std::vector<semblante_companion> to_kernel(std::span<const Companion> companions);

}  // namespace semblante

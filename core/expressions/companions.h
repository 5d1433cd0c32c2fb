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

/// The folds of lids (3.13, 3.14, 3.9, 3.10) that go along with the near edge of their lid (3.1 to 3.4), likewise: the
/// share grows from zero, where the fold is about as far from the edge as on faces with marked folds. A fold at the
/// edge itself, as proposed on eyes that have none, would tear the lid when the edge moves without it.
std::vector<Companion> folds_beside_near_edges(const FeaturePointSet& points);

/// The edges and folds of lower lids (3.3, 3.4, 3.9, 3.10) that go along with a near cheek bone (5.3, 5.4), likewise:
/// below an eye that reaches down to it, a cheek that rises would be pushed through lid and eyeball.
std::vector<Companion> lids_above_near_cheek_bones(const FeaturePointSet& points);

/// The entries of the table of companions (core/tables/data/companions.json) whose two points are marked, the folds
/// below near brows, and those beside near points: these follow by their share what the table leaves.
std::vector<Companion> companions_of(const FeaturePointSet& points);

/// For semblante_rig.companion.
std::vector<semblante_companion> to_kernel(std::span<const Companion> companions);

}  // namespace semblante

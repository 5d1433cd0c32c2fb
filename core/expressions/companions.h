#pragma once

#include <span>
#include <vector>

#include "core/kernel/semblante_kernel.h"
#include "core/types/companion.h"
#include "core/types/feature_points.h"

namespace semblante {

/// The entries of the table of companions (core/tables/data/companions.json) whose two points are marked.
std::vector<Companion> companions_of(const FeaturePointSet& points);

/// For semblante_rig.companion.
std::vector<semblante_companion> to_kernel(std::span<const Companion> companions);

}  // namespace semblante

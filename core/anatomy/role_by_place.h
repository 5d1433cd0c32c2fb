#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/anatomy/part_shape.h"
#include "core/types/feature_points.h"
#include "core/types/rig.h"

namespace semblante {

/// Fills roles still empty after points and names, from place and size relative to the marked points, or to the
/// detected eyes and the skin's box if points are missing. `skin` is the part of the face. Parts that match no rule
/// become `rest`.
void guess_roles_by_place(std::span<const PartShape> shapes, const FeaturePointSet& points, std::size_t skin,
                          std::span<std::optional<PartRole>> roles);

}  // namespace semblante

#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/anatomy/part_shape.h"
#include "core/types/feature_points.h"
#include "core/types/rig.h"

namespace semblante {

/// Fills the roles that points and names left empty, from place and size against the marked points, or against the eyes
/// found and the skin's box where points are missing. `skin` is the part that is the face. What fits nothing is `rest`.
void guess_roles_by_place(std::span<const PartShape> shapes, const FeaturePointSet& points, std::size_t skin,
                          std::span<std::optional<PartRole>> roles);

}  // namespace semblante

#pragma once

#include <optional>
#include <span>

#include "core/anatomy/part_shape.h"
#include "core/types/rig.h"

namespace semblante {

/// Fills empty roles from names that say what a part is ("EyeLeft", "teeth-lower", "M_EyeLashes"): the name of its
/// primitive, and where that says nothing, its material's. Names that only say "teeth" or "gums" are left to their
/// place; "eye" without a side goes by the side it lies on.
void guess_roles_by_name(std::span<const PartShape> shapes, std::span<std::optional<PartRole>> roles);

/// True if the name of a part or its material speaks of teeth or gums, upper or lower.
bool is_named_teeth(const PartShape& shape);

}  // namespace semblante

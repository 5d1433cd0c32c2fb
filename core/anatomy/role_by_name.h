#pragma once

#include <optional>
#include <span>

#include "core/anatomy/part_shape.h"
#include "core/types/rig.h"

namespace semblante {

/// Fills empty roles from descriptive names ("EyeLeft", "teeth-lower", "M_EyeLashes"): the name of the part's
/// primitive, else that of its material. Parts named only "teeth" or "gums" get their roles by place; an
/// "eye" without a side in its name gets the side of its place.
void guess_roles_by_name(std::span<const PartShape> shapes, std::span<std::optional<PartRole>> roles);

/// True if the name of a part or its material contains teeth or gums, upper or lower.
bool is_named_teeth(const PartShape& shape);

}  // namespace semblante

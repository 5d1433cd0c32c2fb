#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/parametrize/part_shape.h"
#include "core/types/rig.h"

namespace semblante {

/// Fills empty roles from names that say what a part is ("EyeLeft", "teeth-lower", "M_EyeLashes"). Names that only say
/// "teeth" or "gums" are left to their place; "eye" without a side goes by the side it lies on.
void guess_roles_by_name(std::span<const PartShape> shapes, std::span<std::optional<PartRole>> roles);

/// True if a name speaks of teeth or gums, upper or lower.
bool names_teeth(std::string_view name);

}  // namespace semblante

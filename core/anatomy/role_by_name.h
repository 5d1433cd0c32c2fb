#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/anatomy/part_shape.h"
#include "core/types/rig.h"

namespace semblante {

/// Fills empty roles from descriptive names ("EyeLeft", "teeth-lower", "M_EyeLashes"): the name of the part's
/// primitive, else that of its material. Parts named only "teeth" or "gums" get their roles by place; an
/// "eye" without a side in its name gets the side of its place, as do eyes on both sides that have one name. Parts
/// named as body or clothing are at rest, unless the skin itself has such a name.
void guess_roles_by_name(std::span<const PartShape> shapes, std::span<std::optional<PartRole>> roles);

/// True if the material of a part, or else its primitive, is named as the skin of a face: "Wolf3D_Head",
/// "Face_00_SKIN".
bool is_face_name(const PartShape& shape);

/// True if it is named as a body, a limb or clothing: "Body_00_SKIN", "Wolf3D_Outfit_Top", "Tops_01_CLOTH". Hair, hats
/// and glasses are none: they follow the head.
bool is_body_name(const PartShape& shape);

/// True if it is named as something that can be neither skin nor body: eyes, teeth, mouth, lashes, hair, glasses.
bool has_name_of_another_part(const PartShape& shape);

/// True for the name of a lid: "upper lids", "EyelidLeft".
bool is_lid_name(std::string_view name);

/// True for a name of what follows the head rigidly wherever it lies: hair, hats and glasses.
bool is_rigid_name(std::string_view name);

/// True if the name of a part or its material contains teeth or gums, upper or lower.
bool is_named_teeth(const PartShape& shape);

}  // namespace semblante

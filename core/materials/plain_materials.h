#pragma once

#include <cstdint>
#include <string_view>

#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// The plain materials, in linear RGB.
enum class Plain : std::uint8_t { skin, sclera, iris, pupil, teeth, mouth, hair, lashes, fluid, neutral };

/// By a name ("Iris", "lashes") of the material, else of the primitive, else by the role of the part.
Plain plain_of(std::string_view material, std::string_view primitive, PartRole role);

Material plain_material(Plain plain);

/// Whether a material is none: plain white, as for an OBJ without its .mtl, or with an image that could not be read.
bool says_nothing(const Material& material);

}  // namespace semblante

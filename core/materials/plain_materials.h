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

/// The file's material of a primitive; null without one.
const Material* material_of(const Model& model, const Primitive& primitive);

/// Whether a material of the file tells nothing about the look: it is plain white, as an OBJ without its .mtl has it,
/// or its image could not be read.
bool says_nothing(const Material& material);

/// Whether the file gives a primitive a look: colours of its vertices, or a material that tells something.
bool has_look(const Model& model, const Primitive& primitive);

}  // namespace semblante

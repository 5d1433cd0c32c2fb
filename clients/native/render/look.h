#pragma once

#include <optional>
#include <string_view>

#include <glm/vec3.hpp>

#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante::render {

/// The substance of a run of triangles, so that a head without materials is recognizable.
enum class Substance { plain, skin, eyeball, iris, teeth, gums, hair, lashes, film };

/// How one run of triangles is drawn.
struct Look {
  Substance substance = Substance::skin;
  glm::vec3 color{0.6F};  ///< linear
  float alpha = 1.0F;
  float roughness = 0.6F;
  float specular = 0.03F;  ///< reflectance at normal incidence
  int image = -1;          ///< index into Model::images, -1: none
  Material::AlphaMode alpha_mode = Material::AlphaMode::opaque;
  float alpha_cutoff = 0.5F;
};

/// Guesses from a name of a material or group ("M_EyeLashes", "teeth-upper"); empty for an unknown name.
std::optional<Substance> substance_by_name(std::string_view name);

/// The look of a primitive. A material with a texture or a colour keeps it; one without (or plain white or grey) gets
/// the colour of its substance: by name first, then by role, which is never skin for clothing; without
/// both skin. Vertices with colours of their own take none from the substance.
Look look_of(const Model& model, const Primitive& primitive, std::optional<PartRole> role);

}  // namespace semblante::render

#pragma once

#include <optional>
#include <span>

#include <glm/mat3x3.hpp>

#include "core/anatomy/reference_heads.h"
#include "core/types/places.h"

namespace semblante {

/// The rotation that turns a face upright whose points are in MPEG-4 axes but for a tilt. Empty if the face is upright,
/// or if the points do not show how it is tilted: too few, on one side only, misplaced, or not a face of about human
/// proportions.
///
/// Yaw and roll are those of the best fit to the reference heads. How far upright faces of different people nod in the
/// same fit differs by up to 7 degrees (as measured on 16 faces, each left out of the references), so the pitch of a
/// head without yaw and roll is left as it is up to 12 degrees.
std::optional<glm::dmat3> upright_rotation(Places places,
                                           std::span<const ReferenceHead> references = reference_heads());

}  // namespace semblante

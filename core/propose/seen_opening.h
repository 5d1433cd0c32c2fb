#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "core/propose/face_front.h"

namespace semblante {

/// An eye as it is seen between its lids.
struct SeenOpening {
  SeenSpot upper, lower, left, right;
};

/// The opening in which an eyeball is seen; `centre` and `radius` are the ball's, in the frame of the face. Empty if
/// the eye is shut.
std::optional<SeenOpening> find_seen_opening(const FaceFront& front, const glm::dvec3& centre, double radius);

}  // namespace semblante

#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "core/anatomy/mirror_plane.h"
#include "core/types/places.h"

namespace semblante {

/// The plane across which the marked points of a face are mirror images, whatever its proportions: a creature's shows
/// yaw and roll as a person's does. Of pitch it shows nothing.
struct PointSymmetry {
  MirrorPlane plane;
  /// Distances from the mirror image, in the length of a pair (about ES0), of seven tenths of the points at most.
  double off = 0.0;
};

/// Robust: the three tenths of the points that are farthest from their mirror images are excluded. The face looks
/// roughly along +Z with +Y up. Empty with too few pairs, or if the points have no plane of symmetry.
std::optional<PointSymmetry> symmetry_of_points(const Places& places);

}  // namespace semblante

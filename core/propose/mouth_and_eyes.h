#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "core/propose/face_surface.h"
#include "core/propose/mirror_plane.h"
#include "core/types/rig.h"

namespace semblante {

/// A place, and the surface vertex there if there is one.
struct Spot {
  glm::dvec3 place{0.0};
  std::optional<std::uint32_t> vertex;
};

/// The pupil of a neutral eye: where the ball of that eye is farthest out. Without a ball (a disc for an iris, an eye
/// painted on the skin) the vertex at `guess`, if there is one, or the bare place.
Spot find_pupil(const FaceSurface& face, std::span<const Part> parts, PartRole eye, const glm::dvec3& guess);

/// Whether the tongue is a piece of its own; with the gums in one piece its ends cannot be told from theirs.
bool is_tongue_alone(const FaceSurface& face);

/// The top of a tongue alone, half way from its tip to its rearmost vertex on the plane; `guess` where that is nowhere
/// near.
glm::dvec3 middle_of_tongue(const FaceSurface& face, const MirrorPlane& plane, const glm::dvec3& tip,
                            const glm::dvec3& guess);

/// The vertex of a tongue alone farthest to one side (+1 left, -1 right) at the depth of its middle.
std::optional<std::uint32_t> border_of_tongue(const FaceSurface& face, const glm::dvec3& middle, double side);

}  // namespace semblante

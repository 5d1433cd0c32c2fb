#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "core/anatomy/mirror_plane.h"
#include "core/geometry/sphere_fit.h"
#include "core/propose/face_surface.h"
#include "core/types/rig.h"

namespace semblante {

/// The sphere of an eyeball, fitted to the largest part with the role; empty without such a part, or if it is not
/// round.
std::optional<Sphere> find_eyeball(const FaceSurface& face, std::span<const Part> parts, PartRole eye);

/// The pupil of a neutral eye: the frontmost point on the axis of its eyeball. Without a ball (a disc as iris, an eye
/// painted on the skin) the position of the vertex at `guess`, if any, else `guess`.
glm::dvec3 find_pupil(const FaceSurface& face, std::span<const Part> parts, PartRole eye, const glm::dvec3& guess);

/// Whether the tongue is a separate piece; if it is one piece with the gums, its ends cannot be identified.
bool is_tongue_alone(const FaceSurface& face);

/// The top of a separate tongue, half way from its tip to its rearmost vertex on the plane; `guess` if the result is
/// too far from it.
glm::dvec3 middle_of_tongue(const FaceSurface& face, const MirrorPlane& plane, const glm::dvec3& tip,
                            const glm::dvec3& guess);

/// The outermost vertex of a separate tongue to one side (+1 left, -1 right) at the depth of its middle.
std::optional<std::uint32_t> border_of_tongue(const FaceSurface& face, const glm::dvec3& middle, double side);

}  // namespace semblante

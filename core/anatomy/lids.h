#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "core/anatomy/lid_edge.h"
#include "core/anatomy/modelled_eye.h"
#include "core/geometry/sphere_fit.h"
#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/rig.h"

namespace semblante {

/// The least slit, radians: that of lids that touch or overlap.
inline constexpr double least_slit = 0.001;

/// How the lids of one eye (0 left, 1 right) roll on the eyeball. Empty if their edges are not known or not before the
/// pivot. An eye that is closed on the neutral face has next to no slit to close, and can open. Reads the rig's parts,
/// points, FAPUs, pivots and irises. `modelled`: the eye, if it is in the skin.
std::optional<Lids> find_lids(const Surface& surface, const EyeEdges& edges, const Rig& rig, std::size_t eye,
                              const ModelledEye* modelled = nullptr);

/// The distance of the eyeball's surface from the eye's pivot in the direction `d`, with the eye turned so that `gaze`
/// is `pole`. Not for a zero vector.
double radius_towards(const Lids& lids, const glm::dvec3& pole, const glm::dvec3& d);

/// The eyeball as a sphere about its pivot, with its least radius: what lies behind it is hidden. Empty if the eyeball
/// is no part of its own, or if no lids roll on it.
std::optional<Sphere> hiding_ball(const Rig& rig, std::size_t eye);

}  // namespace semblante

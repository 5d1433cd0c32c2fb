#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include "core/anatomy/mirror_plane.h"
#include "core/propose/face_surface.h"
#include "core/types/feature_point_id.h"

namespace semblante {

/// Finds a point that is an extreme of the shape (the tip, the highest, the rearmost), near `place`, the position by
/// proportions. Empty for points that are not extremes.
std::optional<std::uint32_t> find_extreme(const FaceSurface& face, const MirrorPlane& plane, FeaturePointId id,
                                          const glm::dvec3& place);

/// The role of the part on which a point is.
PartRole role_of_point(FeaturePointId id);

}  // namespace semblante

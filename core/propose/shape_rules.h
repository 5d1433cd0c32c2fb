#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include "core/propose/face_surface.h"
#include "core/propose/mirror_plane.h"
#include "core/types/feature_point_id.h"

namespace semblante {

/// Where the shape itself tells where a point is (the tip, the highest, the rearmost), looked for about `place`, which
/// is where proportions put it. Nothing for points that are no extremes of the shape.
std::optional<std::uint32_t> find_extreme(const FaceSurface& face, const MirrorPlane& plane, FeaturePointId id,
                                          const glm::dvec3& place);

/// The part that a point lies on.
PartRole role_of_point(FeaturePointId id);

}  // namespace semblante

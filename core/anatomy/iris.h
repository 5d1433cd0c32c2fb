#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/moving_parts.h"
#include "core/types/rig.h"

namespace semblante {

/// The part of an eye that a growing pupil moves.
struct IrisOfEye {
  Iris shape;
  std::vector<SurfaceVertexId> vertices;  ///< iris and pupil, rising
};

/// The iris of the eye with `role`; nullopt with the reason in `why_not`, a text after "the left eye ...".
///
/// Its axis goes from the eye's pivot through the pupil point; where that point is a corner of a flat regular face at
/// the front, as on eyes that have no vertex there, through the middle of the face. Its size is that of a flat part of
/// its own (an iris disc), else the standard's neutral face: the lids touch the iris, so IRISD0 is its diameter, and
/// the pupil is a third of it. Its vertices are those of the eye's parts within that size, except a part in front of
/// another: that is the cornea, which does not move.
std::optional<IrisOfEye> find_iris(const Model& model, const Surface& surface, std::span<const Part> parts,
                                   PartRole role, const FeaturePointSet& points, const glm::vec3& pivot,
                                   std::optional<double> iris_diameter, std::string& why_not);

}  // namespace semblante

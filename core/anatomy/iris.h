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

/// The iris of the eye with `role`; nullopt with the reason in `why_not`, a text that continues "the left eye ...".
///
/// The axis of the iris leads from the eye's pivot through the pupil point. If the pupil of the mesh is a round hole,
/// the axis leads through the centre of the hole (`middle_of_pupil_hole`); if the point is a corner of a flat regular
/// face at the front (of eyes without a vertex at the pupil), through the centre of that face. If the iris is a
/// separate flat part (an iris disc), that part defines its size. Otherwise `iris_radius` (core/types/iris_size.h)
/// does, from `iris_diameter`, which is IRISD0 in model units. The pupil is `pupil_of_iris` of it. The vertices of the
/// iris are those of the eye's parts within this size, except those of a part in front of another, which is the cornea
/// and does not move.
std::optional<IrisOfEye> find_iris(const Model& model, const Surface& surface, std::span<const Part> parts,
                                   PartRole role, const FeaturePointSet& points, const glm::vec3& pivot,
                                   std::optional<double> iris_diameter, std::string& why_not);

}  // namespace semblante

#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "core/anatomy/part_shape.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"

namespace semblante {

/// Two eyeballs among a model's parts, found by name or as two equal balls.
struct EyePair {
  glm::dvec3 middle{0.0};
  int axis = 0;  ///< they lie apart along this one
  double separation = 0.0;
  bool by_name = false;
};

/// Empty unless there are two eyeballs that are apart along one axis of the file.
std::optional<EyePair> find_eyes(std::span<const PartShape> shapes);

/// Centre of the parts named teeth, gums or tongue.
std::optional<glm::dvec3> find_mouth(std::span<const PartShape> shapes);

/// The open end of a neck: the longest border of a part, if it is flat and at an end of the part along an axis.
struct NeckOpening {
  int axis = 0;
  double sign = 0.0;  ///< which end
};
std::optional<NeckOpening> find_neck(const Model& model, const Surface& surface, PartId part);

/// The axis of mirror symmetry of a part, if its symmetry is clearly better than that of the other axes.
std::optional<int> find_mirror_axis(const PartShape& shape);

/// How far the vertices are concentrated towards one end of an axis, as a fraction of the part's extent: a head has its
/// smallest triangles in the face. `shape` is the shape of `part`.
double crowding(const Model& model, const Surface& surface, PartId part, const PartShape& shape, int axis);

}  // namespace semblante

#pragma once

#include <array>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// Where the iris of one eye is painted. Model units.
struct PaintedEye {
  glm::vec3 pivot{0.0F};
  glm::vec3 axis{0.0F, 0.0F, 1.0F};  ///< unit vector from the pivot through the centre of the pupil
  float iris_radius = 0.0F;          ///< 0: nothing is painted
};

struct EyeLook {
  std::array<std::optional<PaintedEye>, 2> eyes;  ///< left, right
  /// #V file vertices: tells a cornea, which does not move with the iris, from the iris behind it. Empty: unknown.
  std::span<const RigidMotion> motion;
};

/// The eyes of a parametrized head. An eye is painted at its iris in `rig`; without one, around its pupil (3.5, 3.6) in
/// the size of `iris_radius` (core/types/iris_size.h). The result refers to `rig`.
EyeLook eyes_of(const Rig& rig);

/// The eyes of a head without feature points, by the bounding boxes of its eyeballs; they look straight ahead.
EyeLook guessed_eyes(std::span<const Part> parts);

/// Gives eyeballs to which the file gave no texture, and no colour but white, a texture with a round iris and pupil:
/// adds the image, its material and texture coordinates, measured from the axis of the eye, and divides primitives. A
/// part over an iris that moves gets the same white and a round window before the iris. Every viewer then draws the
/// same eye, at each pixel, and it turns and its pupil grows with the vertices. `parts` by PartId. Other eyes
/// with a look of their own, and heads without eyeballs, stay as they are.
void paint_eyes(Model& model, const Surface& surface, std::span<const Part> parts, const EyeLook& look);

}  // namespace semblante

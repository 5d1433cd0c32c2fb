#pragma once

#include <optional>
#include <span>

#include <glm/vec2.hpp>

#include "core/anatomy/front_relief.h"
#include "core/anatomy/reference_heads.h"
#include "core/geometry/similarity.h"

namespace semblante {

/// Where a face is, by what is seen straight from the front.
struct SeenFace {
  /// From the frame of the relief to one of unit ES0, with its origin between the pupils. Rotates about Z only.
  Similarity frame;
  double likeness = 0.0;  ///< correlation of its relief with that of the reference heads; at most 1
  /// The slopes of its depths along x and y, in `frame`, beside those of the reference heads: 0 where it looks along
  /// +Z.
  glm::dvec2 slopes{0.0};
};

/// The place and the size at which a model is most like the face that the mean of `references` has: the depths that
/// are seen at the places of the feature points are compared, beside the slopes and the curvature that any round thing
/// has. A face is looked for near the top of what is seen, upright within a few degrees. Empty where none is clearly
/// like one.
std::optional<SeenFace> search_face(const FrontRelief& relief, std::span<const ReferenceHead> references);

/// The same for a face that leans to a shoulder, by up to 65 degrees. It has to be more like one.
std::optional<SeenFace> search_leaning_face(const FrontRelief& relief, std::span<const ReferenceHead> references);

}  // namespace semblante

#pragma once

#include <optional>
#include <span>

#include "core/anatomy/front_relief.h"
#include "core/anatomy/reference_heads.h"
#include "core/geometry/similarity.h"

namespace semblante {

/// Where a face is, by what is seen straight from the front.
struct SeenFace {
  /// From the model's frame to an upright one of unit ES0, with its origin between the pupils. Without a rotation.
  Similarity frame;
  double likeness = 0.0;  ///< correlation of its relief with that of the reference heads; at most 1
};

/// The place and the size at which a model is most like the face that the mean of `references` has: the depths that
/// are seen at the places of the feature points are compared, beside the slopes and the curvature that any round thing
/// has. A face is looked for near the top of what is seen. Empty where none is clearly like one.
std::optional<SeenFace> search_face(const FrontRelief& relief, std::span<const ReferenceHead> references);

}  // namespace semblante

#pragma once

#include "core/types/model.h"

namespace semblante {

/// Edge of the square image, pixels.
inline constexpr int eye_texture_size = 256;

/// A PNG of an eye from the front: pupil, iris with fibres and a dark border, and white around it. The image shows
/// `span` radii of the iris on each side of its centre (1 or more); the pupil's radius is `pupil` of the iris's.
Image eye_texture(float span, float pupil);

}  // namespace semblante

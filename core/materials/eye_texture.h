#pragma once

#include "core/types/model.h"

namespace semblante {

/// Edge of the square image, pixels.
inline constexpr int eye_texture_size = 256;

/// A PNG of an eye from the front: pupil, iris with fibres and a dark border, and white around it. The image shows
/// `span` radii of the iris on each side of its centre (1 or more); the pupil's radius is `pupil_of_iris` of the
/// iris's.
Image eye_texture(float span);

/// The same white, and nothing (alpha 0) before the iris: of a surface over an eye that has its own iris.
Image cornea_texture(float span);

}  // namespace semblante

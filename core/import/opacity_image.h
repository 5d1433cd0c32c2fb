#pragma once

#include <optional>

#include "core/import/pixels.h"
#include "core/types/model.h"

namespace semblante::import {

/// An image of colour with opacity.
struct OpacityImage {
  Image image;  ///< PNG
  Material::AlphaMode mode = Material::AlphaMode::mask;
};

/// The colours of one image with the opacity of another: its alpha channel, or its brightness if it has none. Without
/// `color`, white. At most 2048 pixels along a side, because a PNG of hair is large. `blend` if much of what is seen is
/// neither opaque nor clear, as of strands of hair; a mask hides what is behind it and casts a shadow. Empty if all of
/// it is opaque.
std::optional<OpacityImage> with_opacity(const Pixels* color, const Pixels& opacity);

}  // namespace semblante::import

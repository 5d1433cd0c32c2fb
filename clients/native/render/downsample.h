#pragma once

#include <cstdint>
#include <span>

#include "clients/native/render/picture.h"

namespace semblante::render {

/// Averages blocks of factor x factor pixels in linear light and blends the result over a grey backdrop.
/// `rgba`: (width * factor) x (height * factor), rows from the BOTTOM as OpenGL reads them, sRGB encoded,
/// premultiplied in linear light, linear alpha.
Picture downsample(std::span<const std::uint8_t> rgba, int width, int height, int factor);

}  // namespace semblante::render

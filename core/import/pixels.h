#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/import/image_size.h"
#include "core/types/result.h"

namespace semblante::import {

/// A decoded image: RGBA, 8 bits each, rows from the top.
struct Pixels {
  static constexpr std::size_t channels = 4;

  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< width * height * channels
};

/// Decodes a PNG or a JPEG of a size that the caller has checked. Errors: `malformed`; messages continue a sentence
/// that begins with the image's name ("is ...").
Result<Pixels> decode_image(std::span<const std::uint8_t> bytes, const ImageSize& size);

/// Each pixel is the mean of those of `pixels` that it covers, or the nearest one where it covers none.
Pixels resized(const Pixels& pixels, int width, int height);

}  // namespace semblante::import

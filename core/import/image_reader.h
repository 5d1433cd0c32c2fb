#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/import/image_size.h"
#include "core/import/limits.h"
#include "core/import/pixels.h"
#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante::import {

/// Makes the images of one file such that every client can show them.
class ImageReader {
 public:
  explicit ImageReader(const ImportLimits& limits) : limits_(limits), pixels_left_(limits.max_decoded_pixels) {}

  /// PNG and JPEG, told by their content, as they are, if their header declares a size; WebP converted (webp.h). An
  /// error for anything else or for more than the limits; its message continues a sentence that begins with the image's
  /// name ("is ...").
  Result<Image> read(std::vector<std::uint8_t> bytes);

  /// Decodes an image that read() gave, within the limits of decoded pixels. Errors: as of read().
  Result<Pixels> decode(const Image& image);

 private:
  /// Counts an image of this size, called `format`, as decoded, if that is within the limits.
  Status admit(const ImageSize& size, std::string_view format);

  ImportLimits limits_;
  std::size_t pixels_left_;
};

}  // namespace semblante::import

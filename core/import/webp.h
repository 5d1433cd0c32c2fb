#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/import/image_size.h"
#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante::import {

/// The size that the header of a WebP declares, at most 16383 either way. Nothing is decoded. Errors: `malformed`; a
/// moving picture is `unsupported`. Messages continue a sentence that begins with the image's name ("is ...").
Result<ImageSize> webp_size(std::span<const std::uint8_t> bytes);

/// Decodes a WebP and encodes it again, because neither glTF's core nor the image readers of the clients have it: as
/// JPEG if it is lossy and opaque, else as PNG. The caller has checked its size. Errors as above.
Result<Image> converted_webp(std::span<const std::uint8_t> bytes);

}  // namespace semblante::import

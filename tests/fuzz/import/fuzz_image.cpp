// Textures of heads. The input is images, each after its length in three bytes, big-endian: one reader has them all, as
// that of a file does. Each is decoded, and gives its opacity to the one before it.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>

#include "core/import/image_reader.h"
#include "core/import/image_size.h"
#include "core/import/image_type.h"
#include "core/import/opacity_image.h"
#include "core/import/pixels.h"

using namespace semblante;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ImportLimits limits;
  limits.max_image_bytes = std::size_t{1} << 16U;
  limits.max_image_side = 256;
  limits.max_image_pixels = std::size_t{64} * 64;
  limits.max_decoded_pixels = 4 * limits.max_image_pixels;
  import::ImageReader reader(limits);
  constexpr std::size_t length_bytes = 3;
  std::optional<import::Pixels> color;
  while (size >= length_bytes) {
    const std::size_t length = std::min<std::size_t>(data[0] << 16U | data[1] << 8U | data[2], size - length_bytes);
    const auto image = reader.read({data + length_bytes, data + length_bytes + length});
    data += length_bytes + length;
    size -= length_bytes + length;
    if (!image) {
      if (image.error().message.empty()) std::abort();
      continue;
    }
    // Whatever it was, it is now of a type that every client shows, and has a size within the limits.
    if (import::image_type(image->bytes) != image->mime_type) std::abort();
    if (image->mime_type != "image/png" && image->mime_type != "image/jpeg") std::abort();
    const auto declared = import::declared_size(image->bytes);
    if (!declared || declared->pixels() == 0) std::abort();
    if (std::max(declared->width, declared->height) > limits.max_image_side) std::abort();
    auto pixels = reader.decode(*image);
    if (!pixels) {
      if (pixels.error().message.empty()) std::abort();
      continue;
    }
    if (pixels->rgba.size() != declared->pixels() * import::Pixels::channels) std::abort();
    if (const auto made = import::with_opacity(color ? &*color : nullptr, *pixels)) {
      if (import::image_type(made->image.bytes) != "image/png") std::abort();
    }
    color = std::move(*pixels);
  }
  return 0;
}

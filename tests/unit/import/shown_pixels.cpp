#include "tests/unit/import/shown_pixels.h"

#include <cstddef>
#include <memory>

#include <gtest/gtest.h>
#include <stb/stb_image.h>

namespace semblante::test {

ShownPixels pixels_of(const Image& image) {
  ShownPixels out;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> data(
      stbi_load_from_memory(image.bytes.data(), static_cast<int>(image.bytes.size()), &out.width, &out.height,
                            &out.channels, STBI_rgb_alpha),
      &stbi_image_free);
  EXPECT_NE(data, nullptr) << image.mime_type;
  if (data) out.rgba.assign(data.get(), data.get() + std::ptrdiff_t{4} * out.width * out.height);
  return out;
}

}  // namespace semblante::test

#include "core/gltf/encode_image.h"

#include <stb/stb_image_write.h>

namespace semblante {
namespace {

void append(void* bytes, void* data, int size) {
  const auto* const begin = static_cast<const std::uint8_t*>(data);
  auto& to = *static_cast<std::vector<std::uint8_t>*>(bytes);
  to.insert(to.end(), begin, begin + size);
}

}  // namespace

std::vector<std::uint8_t> encode_png(std::span<const std::uint8_t> pixels, int width, int height, int channels) {
  std::vector<std::uint8_t> bytes;
  if (stbi_write_png_to_func(append, &bytes, width, height, channels, pixels.data(), width * channels) == 0) return {};
  return bytes;
}

std::vector<std::uint8_t> encode_jpeg(std::span<const std::uint8_t> pixels, int width, int height, int channels,
                                      int quality) {
  std::vector<std::uint8_t> bytes;
  if (stbi_write_jpg_to_func(append, &bytes, width, height, channels, pixels.data(), quality) == 0) return {};
  return bytes;
}

}  // namespace semblante

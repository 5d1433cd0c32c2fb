#include "core/gltf/encode_image.h"

#include <cstdlib>
#include <zlib.h>

namespace {

/// In place of stb's own compressor, which makes PNG files half as large again. Null: no memory.
unsigned char* deflated(const unsigned char* data, int bytes, int* size, int /*quality*/) {
  uLongf most = ::compressBound(static_cast<uLong>(bytes));
  auto* const to = static_cast<unsigned char*>(std::malloc(most));  // stb frees it
  if (to == nullptr || ::compress2(to, &most, data, static_cast<uLong>(bytes), Z_DEFAULT_COMPRESSION) != Z_OK) {
    std::free(to);
    return nullptr;
  }
  *size = static_cast<int>(most);
  return to;
}

}  // namespace

// stb's image writer is compiled here.
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBIW_ZLIB_COMPRESS deflated
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

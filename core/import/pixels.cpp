#include "core/import/pixels.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>
#include <png.h>
#include <string>
#include <turbojpeg.h>
#include <type_traits>

#include "core/import/image_type.h"

namespace semblante::import {
namespace {

Error cannot_be_decoded(std::string_view format) {
  return {ErrorCode::malformed, "", "is a " + std::string(format) + " that cannot be decoded"};
}

Pixels pixels_of(int width, int height) {
  return {
      width, height,
      std::vector<std::uint8_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * Pixels::channels)};
}

bool is_of(const ImageSize& size, std::size_t width, std::size_t height) {
  return width == size.width && height == size.height;
}

Result<Pixels> decode_png(std::span<const std::uint8_t> bytes, const ImageSize& size) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> owner(&image, &png_image_free);
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0 ||
      !is_of(size, image.width, image.height))
    return cannot_be_decoded("PNG");
  image.format = PNG_FORMAT_RGBA;
  Pixels pixels = pixels_of(static_cast<int>(image.width), static_cast<int>(image.height));
  if (png_image_finish_read(&image, nullptr, pixels.rgba.data(), 0, nullptr) == 0) return cannot_be_decoded("PNG");
  return pixels;
}

Result<Pixels> decode_jpeg(std::span<const std::uint8_t> bytes, const ImageSize& size) {
  const std::unique_ptr<std::remove_pointer_t<tjhandle>, decltype(&tjDestroy)> decoder(tjInitDecompress(), &tjDestroy);
  int width = 0, height = 0, subsampling = 0, color_space = 0;
  if (!decoder ||
      tjDecompressHeader3(decoder.get(), bytes.data(), bytes.size(), &width, &height, &subsampling, &color_space) !=
          0 ||
      !is_of(size, static_cast<std::size_t>(width), static_cast<std::size_t>(height))) {
    return cannot_be_decoded("JPEG");
  }
  Pixels pixels = pixels_of(width, height);
  // What is missing at the end of a truncated file is grey, as in browsers.
  if (tjDecompress2(decoder.get(), bytes.data(), bytes.size(), pixels.rgba.data(), width, 0, height, TJPF_RGBA,
                    TJFLAG_LIMITSCANS) != 0 &&
      tjGetErrorCode(decoder.get()) == TJERR_FATAL) {
    return cannot_be_decoded("JPEG");
  }
  return pixels;
}

/// The range of `size` that the `i`-th of `parts` covers; at least one.
std::array<int, 2> covered(int i, int parts, int size) {
  const auto at = [&](int part) { return static_cast<int>(std::int64_t{part} * size / parts); };
  return {at(i), std::max(at(i) + 1, at(i + 1))};
}

}  // namespace

Result<Pixels> decode_image(std::span<const std::uint8_t> bytes, const ImageSize& size) {
  return image_type(bytes) == "image/png" ? decode_png(bytes, size) : decode_jpeg(bytes, size);
}

Pixels resized(const Pixels& pixels, int width, int height) {
  assert(width > 0 && height > 0);
  if (width == pixels.width && height == pixels.height) return pixels;
  Pixels to = pixels_of(width, height);
  auto* out = to.rgba.data();
  for (int y = 0; y < height; ++y) {
    const auto [top, bottom] = covered(y, height, pixels.height);
    for (int x = 0; x < width; ++x) {
      const auto [left, right] = covered(x, width, pixels.width);
      std::array<unsigned, Pixels::channels> sum{};
      for (int row = top; row < bottom; ++row) {
        const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(pixels.width);
        for (int column = left; column < right; ++column) {
          const auto* const at = &pixels.rgba[(first + static_cast<std::size_t>(column)) * Pixels::channels];
          for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += at[c];
        }
      }
      const auto count = static_cast<unsigned>((bottom - top) * (right - left));
      for (const unsigned s : sum) *out++ = static_cast<std::uint8_t>((s + count / 2) / count);
    }
  }
  return to;
}

}  // namespace semblante::import

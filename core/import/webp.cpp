#include "core/import/webp.h"

#include <memory>
#include <utility>

#include <webp/decode.h>

#include "core/gltf/encode_image.h"

namespace semblante::import {
namespace {

/// Above 90 the encoder keeps the full resolution of the colours.
constexpr int jpeg_quality = 93;

Error cannot_be_decoded() { return {ErrorCode::malformed, "", "is a WebP image that cannot be decoded"}; }

Result<WebPBitstreamFeatures> features_of(std::span<const std::uint8_t> bytes) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK || features.width < 1 ||
      features.height < 1) {
    return cannot_be_decoded();
  }
  if (features.has_animation != 0) {
    return Error{ErrorCode::unsupported, "", "is a WebP image that moves, which no texture can"};
  }
  return features;
}

}  // namespace

Result<ImageSize> webp_size(std::span<const std::uint8_t> bytes) {
  const auto features = features_of(bytes);
  if (!features) return features.error();
  return ImageSize{static_cast<std::size_t>(features->width), static_cast<std::size_t>(features->height)};
}

Result<Image> converted_webp(std::span<const std::uint8_t> bytes) {
  const auto features = features_of(bytes);
  if (!features) return features.error();
  constexpr int lossy = 1;
  const bool has_alpha = features->has_alpha != 0;
  const bool to_jpeg = features->format == lossy && !has_alpha;
  const int channels = has_alpha ? 4 : 3;
  int width = 0;
  int height = 0;
  const auto decode = has_alpha ? &WebPDecodeRGBA : &WebPDecodeRGB;
  const std::unique_ptr<std::uint8_t, decltype(&WebPFree)> pixels(decode(bytes.data(), bytes.size(), &width, &height),
                                                                  &WebPFree);
  if (!pixels) return cannot_be_decoded();
  const std::span rows(pixels.get(), static_cast<std::size_t>(width) * height * channels);
  Image image = to_jpeg ? Image{"image/jpeg", encode_jpeg(rows, width, height, channels, jpeg_quality)}
                        : Image{"image/png", encode_png(rows, width, height, channels)};
  if (image.bytes.empty()) return cannot_be_decoded();
  return image;
}

}  // namespace semblante::import

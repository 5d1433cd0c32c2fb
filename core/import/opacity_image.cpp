#include "core/import/opacity_image.h"

#include <algorithm>
#include <cstdint>

#include "core/gltf/encode_image.h"

namespace semblante::import {
namespace {

constexpr int most_along_side = 2048;

// Of 255.
constexpr std::uint8_t nearly_clear = 25, nearly_opaque = 230;
/// Of the pixels that are seen: from here on a mask would lose too many strands.
constexpr double much = 0.2;

bool has_alpha_channel(const Pixels& pixels) {
  for (std::size_t i = 3; i < pixels.rgba.size(); i += Pixels::channels) {
    if (pixels.rgba[i] < 255) return true;
  }
  return false;
}

std::uint8_t brightness(const std::uint8_t* rgb) {
  return static_cast<std::uint8_t>((299U * rgb[0] + 587U * rgb[1] + 114U * rgb[2] + 500U) / 1000U);
}

}  // namespace

std::optional<OpacityImage> with_opacity(const Pixels* color, const Pixels& opacity) {
  int width = color != nullptr ? color->width : opacity.width;
  int height = color != nullptr ? color->height : opacity.height;
  while (std::max(width, height) > most_along_side) {
    width = std::max(1, width / 2);
    height = std::max(1, height / 2);
  }
  const bool is_alpha = has_alpha_channel(opacity);
  const Pixels fitted = resized(opacity, width, height);
  Pixels made = color != nullptr ? resized(*color, width, height)
                                 : Pixels{width, height, std::vector<std::uint8_t>(fitted.rgba.size(), 255)};
  std::size_t clear = 0, opaque = 0;
  for (std::size_t i = 0; i < made.rgba.size(); i += Pixels::channels) {
    const std::uint8_t alpha = is_alpha ? fitted.rgba[i + 3] : brightness(&fitted.rgba[i]);
    made.rgba[i + 3] = alpha;
    if (alpha < nearly_clear) ++clear;
    if (alpha >= nearly_opaque) ++opaque;
  }
  const std::size_t seen = made.rgba.size() / Pixels::channels - clear;
  const std::size_t partial = seen - opaque;
  if (clear == 0 && partial == 0) return std::nullopt;
  const bool is_soft = static_cast<double>(partial) > much * static_cast<double>(seen);
  return OpacityImage{{"image/png", encode_png(made.rgba, width, height, static_cast<int>(Pixels::channels))},
                      is_soft ? Material::AlphaMode::blend : Material::AlphaMode::mask};
}

}  // namespace semblante::import

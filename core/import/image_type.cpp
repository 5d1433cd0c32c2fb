#include "core/import/image_type.h"

#include <algorithm>
#include <array>

namespace semblante::import {

std::string_view image_type(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 4> png = {0x89, 'P', 'N', 'G'};
  constexpr std::array<std::uint8_t, 3> jpeg = {0xFF, 0xD8, 0xFF};
  if (bytes.size() >= png.size() && std::equal(png.begin(), png.end(), bytes.begin())) return "image/png";
  if (bytes.size() >= jpeg.size() && std::equal(jpeg.begin(), jpeg.end(), bytes.begin())) return "image/jpeg";
  return {};
}

}  // namespace semblante::import

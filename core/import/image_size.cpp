#include "core/import/image_size.h"

#include <string_view>

#include "core/import/image_type.h"
#include "core/import/text.h"

namespace semblante::import {
namespace {

using Bytes = std::span<const std::uint8_t>;

/// A big-endian number.
std::size_t number(Bytes bytes) {
  std::size_t value = 0;
  for (const std::uint8_t byte : bytes) value = value << 8U | byte;
  return value;
}

/// IHDR is the first chunk of every PNG (W3C PNG, 11.2.1).
std::optional<ImageSize> size_of_png(Bytes bytes) {
  constexpr std::size_t width_at = 16, height_at = 20, end = 24;
  constexpr std::string_view beginning("\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR", width_at);
  if (bytes.size() < end || as_text(bytes.subspan(0, width_at)) != beginning) return std::nullopt;
  return ImageSize{number(bytes.subspan(width_at, 4)), number(bytes.subspan(height_at, 4))};
}

/// SOF0 to SOF15 name a frame's size, except for the three markers among them that mean something else (ITU T.81, B.1).
bool starts_a_frame(std::uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

/// Goes from segment to segment up to the first frame.
std::optional<ImageSize> size_of_jpeg(Bytes bytes) {
  std::size_t at = 2;
  while (at + 4 <= bytes.size()) {
    if (bytes[at] != 0xFF) return std::nullopt;
    const std::uint8_t marker = bytes[at + 1];
    if (marker == 0xFF) {  // a fill byte
      ++at;
      continue;
    }
    const std::size_t length = number(bytes.subspan(at + 2, 2));
    if (length < 2) return std::nullopt;
    if (starts_a_frame(marker)) {
      constexpr std::size_t height_in = 5, width_in = 7, end = 9;
      if (bytes.size() - at < end) return std::nullopt;
      return ImageSize{number(bytes.subspan(at + width_in, 2)), number(bytes.subspan(at + height_in, 2))};
    }
    at += 2 + length;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ImageSize> declared_size(Bytes bytes) {
  const auto type = image_type(bytes);
  if (type == "image/png") return size_of_png(bytes);
  if (type == "image/jpeg") return size_of_jpeg(bytes);
  return std::nullopt;
}

bool has_alpha(Bytes bytes) {
  if (!size_of_png(bytes)) return false;
  constexpr std::size_t color_type_at = 25;
  constexpr std::uint8_t alpha_bit = 4;
  if (bytes.size() > color_type_at && (bytes[color_type_at] & alpha_bit) != 0) return true;
  // A chunk before the first of pixels may name transparent colours (W3C PNG, 11.3.1.1).
  constexpr std::size_t signature = 8, frame = 12, type_in = 4;
  for (std::size_t at = signature; bytes.size() - at >= frame;) {
    const std::string_view type = as_text(bytes.subspan(at + type_in, 4));
    if (type == "tRNS") return true;
    const std::size_t length = number(bytes.subspan(at, 4));
    if (type == "IDAT" || length > bytes.size() - at - frame) return false;
    at += frame + length;
  }
  return false;
}

}  // namespace semblante::import

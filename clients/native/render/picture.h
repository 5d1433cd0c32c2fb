#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/types/result.h"

namespace semblante::render {

/// One colour, sRGB encoded.
using Rgb = std::array<std::uint8_t, 3>;

/// A finished picture: rows from the top, three sRGB bytes per pixel.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  ///< width * height * 3

  Picture() = default;
  Picture(int w, int h, Rgb fill);

  /// Copies `other` with its top left corner at (x, y); clips the parts outside of this picture.
  void paste(const Picture& other, int x, int y);
};

/// The picture as the bytes of a PNG file. Never empty for a picture with pixels.
std::vector<std::uint8_t> encode_png(const Picture& picture);

/// The picture as the bytes of a JPEG file. `quality`: 1 to 100.
std::vector<std::uint8_t> encode_jpeg(const Picture& picture, int quality);

/// Writes a PNG. Errors: io, with the path in `where`.
Status write_png(const Picture& picture, const std::filesystem::path& path);
/// Writes a JPEG. Errors: io, with the path in `where`.
Status write_jpeg(const Picture& picture, const std::filesystem::path& path, int quality);

/// Mean absolute difference of two pictures of the same size, 0..255 per channel.
double mean_difference(const Picture& a, const Picture& b);

}  // namespace semblante::render

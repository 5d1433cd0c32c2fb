#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace semblante {

/// 8-bit pixels in rows from the top as the bytes of a PNG or JPEG file. `channels`: 3 (RGB) or 4 (RGBA, which JPEG
/// drops); `pixels` has width * height * channels bytes. `quality`: 1 to 100. Empty if the encoder fails.
std::vector<std::uint8_t> encode_png(std::span<const std::uint8_t> pixels, int width, int height, int channels);
std::vector<std::uint8_t> encode_jpeg(std::span<const std::uint8_t> pixels, int width, int height, int channels,
                                      int quality);

}  // namespace semblante

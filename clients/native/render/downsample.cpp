#include "clients/native/render/downsample.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "clients/native/render/backdrop.h"

namespace semblante::render {
namespace {

constexpr int encode_steps = 4096;

float decode_srgb(float v) { return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F); }

float encode_srgb(float v) { return v <= 0.0031308F ? v * 12.92F : 1.055F * std::pow(v, 1 / 2.4F) - 0.055F; }

struct Tables {
  std::array<float, 256> linear{};
  std::array<std::uint8_t, encode_steps + 1> encoded{};
  Tables() {
    for (int i = 0; i < 256; ++i) {
      linear[static_cast<std::size_t>(i)] = decode_srgb(static_cast<float>(i) / 255.0F);
    }
    for (int i = 0; i <= encode_steps; ++i) {
      const float value = encode_srgb(static_cast<float>(i) / encode_steps);
      encoded[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(value * 255.0F));
    }
  }
};

}  // namespace

Picture downsample(std::span<const std::uint8_t> rgba, int width, int height, int factor) {
  static const Tables tables;
  Picture picture(width, height, {0, 0, 0});
  const auto row_bytes = static_cast<std::size_t>(width) * factor * 4;
  const float share = 1.0F / static_cast<float>(factor * factor);
  for (int y = 0; y < height; ++y) {
    const float down = static_cast<float>(y) / static_cast<float>(height);
    for (int x = 0; x < width; ++x) {
      std::array<float, 3> sum{};
      float alpha = 0;
      for (int j = 0; j < factor; ++j) {
        const std::size_t row = static_cast<std::size_t>(height - 1 - y) * factor + j;
        for (int i = 0; i < factor; ++i) {
          const std::uint8_t* pixel = &rgba[row * row_bytes + (static_cast<std::size_t>(x) * factor + i) * 4];
          for (std::size_t c = 0; c < 3; ++c) {
            sum[c] += tables.linear[pixel[c]];
          }
          alpha += static_cast<float>(pixel[3]) / 255.0F;
        }
      }
      for (std::size_t c = 0; c < 3; ++c) {
        const float behind = backdrop_top[c] + (backdrop_bottom[c] - backdrop_top[c]) * down;
        const float light = sum[c] * share + behind * (1.0F - alpha * share);
        const auto step = std::clamp(std::lround(light * encode_steps), 0L, static_cast<long>(encode_steps));
        picture.rgb[(static_cast<std::size_t>(y) * width + x) * 3 + c] = tables.encoded[static_cast<std::size_t>(step)];
      }
    }
  }
  return picture;
}

}  // namespace semblante::render

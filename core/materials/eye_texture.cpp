#include "core/materials/eye_texture.h"

#include <cassert>
#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "core/gltf/encode_image.h"
#include "core/types/color.h"
#include "core/types/moving_parts.h"

namespace semblante {
namespace {

constexpr int samples = 4;  // a pixel is the mean of samples by samples places

// Linear RGB.
const glm::vec3 sclera_white(0.85F, 0.84F, 0.81F);
const glm::vec3 inner(0.20F, 0.25F, 0.24F);
const glm::vec3 outer(0.07F, 0.12F, 0.15F);
const glm::vec3 border(0.02F);
const glm::vec3 black(0.006F);

/// At a place in radii of the iris.
glm::vec3 color_at(float x, float y) {
  const float r = std::hypot(x, y);
  if (r > 1.1F) return sclera_white;
  const float angle = std::atan2(y, x);
  const float fibres = 0.84F + 0.16F * std::sin(angle * 23.0F) * std::sin(angle * 9.0F + 1.0F);
  glm::vec3 color = glm::mix(inner, outer, glm::smoothstep(pupil_of_iris, 0.95F, r)) * fibres;
  color = glm::mix(color, border, glm::smoothstep(0.84F, 0.98F, r));
  color = glm::mix(black, color, glm::smoothstep(pupil_of_iris - 0.03F, pupil_of_iris + 0.03F, r));
  return glm::mix(color, sclera_white, glm::smoothstep(0.96F, 1.05F, r));
}

/// A square of pixels, each the mean of `value(x, y)`, whose channels `encode` stores.
template <class Value, class Encode>
Image square(float span, int channels, Value value, Encode encode) {
  assert(span >= 1.0F);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(static_cast<std::size_t>(eye_texture_size) * eye_texture_size * static_cast<std::size_t>(channels));
  constexpr int across = eye_texture_size * samples;
  const auto place = [&](int sample) {
    return span * (2.0F * (static_cast<float>(sample) + 0.5F) / static_cast<float>(across) - 1.0F);
  };
  for (int row = 0; row < eye_texture_size; ++row) {
    for (int column = 0; column < eye_texture_size; ++column) {
      auto sum = decltype(value(0.0F, 0.0F))(0.0F);
      for (int s = 0; s < samples * samples; ++s)
        sum += value(place(column * samples + s % samples), -place(row * samples + s / samples));
      encode(sum / static_cast<float>(samples * samples), pixels);
    }
  }
  return {"image/png", encode_png(pixels, eye_texture_size, eye_texture_size, channels)};
}

void add_color(const glm::vec3& color, std::vector<std::uint8_t>& pixels) {
  const Color8 encoded = srgb_of_linear(color);
  pixels.insert(pixels.end(), encoded.begin(), encoded.end());
}

}  // namespace

Image eye_texture(float span) { return square(span, 3, color_at, add_color); }

Image cornea_texture(float span) {
  const auto alpha_at = [](float x, float y) { return std::hypot(x, y) < 1.0F ? 0.0F : 1.0F; };
  return square(span, 4, alpha_at, [](float alpha, std::vector<std::uint8_t>& pixels) {
    add_color(sclera_white, pixels);
    pixels.push_back(static_cast<std::uint8_t>(std::lround(255.0F * alpha)));
  });
}

}  // namespace semblante

#include "core/types/color.h"

#include <algorithm>
#include <cmath>

namespace semblante {
namespace {

std::array<float, 256> linear_values() {
  std::array<float, 256> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double s = static_cast<double>(i) / 255.0;
    values[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  }
  return values;
}

}  // namespace

Color8 srgb_of_linear(const glm::vec3& linear) {
  Color8 color{};
  for (int c = 0; c < 3; ++c) {
    const double value = std::clamp(static_cast<double>(linear[c]), 0.0, 1.0);
    const double s = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
    color[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(255.0 * s));
  }
  return color;
}

glm::vec3 linear_of_srgb(const Color8& color) {
  static const std::array<float, 256> values = linear_values();
  return {values[color[0]], values[color[1]], values[color[2]]};
}

}  // namespace semblante

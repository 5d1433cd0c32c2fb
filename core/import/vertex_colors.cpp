#include "core/import/vertex_colors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

namespace semblante::import {
namespace {

constexpr float greatest_of_bytes = 255.0F;
constexpr float greatest_of_shorts = 65535.0F;
/// Averages of colours within 0..1 exceed 1 by little; a file of 0..255 has more somewhere.
constexpr float most_of_reals = 2.0F;

/// Calls `see` with each corner of a primitive's triangles.
template <class See>
void for_each_corner(const Model& model, const Primitive& primitive, const See& see) {
  for (std::size_t t = primitive.first_triangle; t < std::size_t{primitive.first_triangle} + primitive.triangle_count;
       ++t) {
    for (const std::uint32_t vertex : model.triangles[t]) see(vertex);
  }
}

}  // namespace

const glm::vec3 no_color(std::numeric_limits<float>::quiet_NaN());

bool is_color(const glm::vec3& given) {
  for (int c = 0; c < 3; ++c) {
    if (!(std::abs(given[c]) <= greatest_of_shorts)) return false;
  }
  return true;
}

float full_light(std::span<const glm::vec3> given, ColorNumbers numbers) {
  if (numbers == ColorNumbers::bytes) return greatest_of_bytes;
  float most = 0.0F;
  for (const glm::vec3& color : given) {
    if (is_color(color)) most = std::max({most, color.r, color.g, color.b});
  }
  if (most > greatest_of_bytes) return greatest_of_shorts;
  return numbers == ColorNumbers::integers || most > most_of_reals ? greatest_of_bytes : 1.0F;
}

void append_colors(std::span<const glm::vec3> given, float full, ColorSpace space, std::vector<Color8>& to) {
  for (const glm::vec3& numbers : given) {
    if (!is_color(numbers)) {
      to.push_back(white);
      continue;
    }
    const glm::vec3 color = glm::clamp(numbers / full, 0.0F, 1.0F);
    if (space == ColorSpace::linear) {
      to.push_back(srgb_of_linear(color));
      continue;
    }
    const auto byte = [](float value) { return static_cast<std::uint8_t>(std::lround(255.0F * value)); };
    to.push_back({byte(color.r), byte(color.g), byte(color.b)});
  }
}

std::string warning_of_faulty_colors(std::size_t count) {
  return std::to_string(count) + " vertices have a colour that is not three numbers: they are white";
}

bool keep_seen_colors(Model& model) {
  bool is_any_seen = false;
  bool are_black = true;
  std::vector<bool> is_kept(model.colors.size());
  for (Primitive& primitive : model.primitives) {
    if (!primitive.has_colors) continue;
    primitive.has_colors = false;
    for_each_corner(model, primitive, [&](std::uint32_t vertex) {
      primitive.has_colors = primitive.has_colors || model.colors[vertex] != white;
    });
    if (!primitive.has_colors) continue;
    is_any_seen = true;
    for_each_corner(model, primitive, [&](std::uint32_t vertex) {
      is_kept[vertex] = true;
      are_black = are_black && model.colors[vertex] == Color8{};
    });
  }
  if (!is_any_seen || are_black) {
    model.colors.clear();
    for (Primitive& primitive : model.primitives) primitive.has_colors = false;
    return is_any_seen;
  }
  for (std::size_t v = 0; v < is_kept.size(); ++v) {
    if (!is_kept[v]) model.colors[v] = white;
  }
  return false;
}

}  // namespace semblante::import

#pragma once

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

namespace semblante {

/// The colour of a vertex: red, green, blue, sRGB, a byte each. Scanners write it so, and sRGB spends the 256 steps as
/// the eye sees them: 8 linear bits would show bands in the dark.
using Color8 = std::array<std::uint8_t, 3>;

inline constexpr Color8 white = {255, 255, 255};

/// `linear` within 0..1; others are clamped.
Color8 srgb_of_linear(const glm::vec3& linear);
glm::vec3 linear_of_srgb(const Color8& color);

}  // namespace semblante

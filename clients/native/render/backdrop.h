#pragma once

#include <array>

namespace semblante::render {

/// The grey behind every head, linear light: at the upper edge of a picture, and at the lower.
inline constexpr std::array<float, 3> backdrop_top = {0.80F, 0.81F, 0.83F};
inline constexpr std::array<float, 3> backdrop_bottom = {0.52F, 0.53F, 0.55F};

}  // namespace semblante::render

#pragma once

#include <cmath>
#include <cstdint>

#include "core/types/model.h"

namespace semblante::testing {

/// A unit ball of rings around Y whose first and last meridian lie at one place, as a UV seam makes them.
inline Model seamed_ball(std::uint32_t rings = 16, std::uint32_t columns = 24) {
  constexpr float pi = 3.14159265F;
  Model model;
  for (std::uint32_t r = 0; r <= rings; ++r) {
    const float polar = pi * static_cast<float>(r) / static_cast<float>(rings);
    const float radius = r == 0 || r == rings ? 0.0F : std::sin(polar);  // the poles are points, to the last bit
    for (std::uint32_t c = 0; c <= columns; ++c) {
      // The same angle, and so the same float positions, on both sides of the seam.
      const float around = 2 * pi * static_cast<float>(c % columns) / static_cast<float>(columns);
      model.positions.emplace_back(radius * std::sin(around), std::cos(polar), radius * std::cos(around));
      model.uvs.emplace_back(static_cast<float>(c) / static_cast<float>(columns),
                             static_cast<float>(r) / static_cast<float>(rings));
    }
  }
  const std::uint32_t row = columns + 1;
  for (std::uint32_t r = 0; r < rings; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) {
      const std::uint32_t a = r * row + c;
      model.triangles.push_back({a, a + row, a + 1});
      model.triangles.push_back({a + 1, a + row, a + row + 1});
    }
  }
  model.uv_triangles = model.triangles;
  model.primitives = {{"head", -1, 0, static_cast<std::uint32_t>(model.triangles.size())}};
  return model;
}

}  // namespace semblante::testing

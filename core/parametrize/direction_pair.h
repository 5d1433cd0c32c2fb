#pragma once

#include <cstddef>

#include <glm/vec3.hpp>

namespace semblante {

/// Two numbers side by side, in one register of every machine.
using NumberPair = double __attribute__((vector_size(16)));

/// Two directions side by side. Where there is none it is zero, which is at right angles to everything.
struct DirectionPair {
  NumberPair x{}, y{}, z{};

  void set(std::size_t lane, const glm::dvec3& direction) {
    x[lane] = direction.x;
    y[lane] = direction.y;
    z[lane] = direction.z;
  }
  [[nodiscard]] NumberPair dot(const glm::dvec3& v) const { return v.x * x + v.y * y + v.z * z; }
};

}  // namespace semblante

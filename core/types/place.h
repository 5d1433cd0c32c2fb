#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "core/types/seeded_hash.h"

namespace semblante {

/// A position as a key: two vertices are at one place if their float32 coordinates are equal, -0 to +0.
using PlaceKey = std::array<std::uint32_t, 3>;

inline PlaceKey place_key(const glm::vec3& p) {
  const auto bits = [](float x) { return x == 0.0F ? 0U : std::bit_cast<std::uint32_t>(x); };
  return {bits(p.x), bits(p.y), bits(p.z)};
}

struct PlaceHash {
  std::size_t operator()(const PlaceKey& key) const { return SeededHash::of(key[0], key[1], key[2]); }
};

}  // namespace semblante

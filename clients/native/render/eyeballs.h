#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "clients/native/render/camera.h"
#include "core/types/model.h"

namespace semblante::render {

/// The eyeballs of a head as far as drawing needs them.
struct Eyeballs {
  /// #V: the vertex from its eyeball's centre in units of its radius, w = 1; all 0 elsewhere. Where an eye has no
  /// texture and no iris of its own, the shader paints one around +Z of this.
  std::vector<glm::vec4> place;
  /// Boxes of the two largest, the face's left first; empty when there are not two.
  std::optional<std::array<Box, 2>> pair;
};

/// `is_eye`: one value a triangle.
Eyeballs find_eyeballs(std::span<const glm::vec3> positions, std::span<const Triangle> triangles,
                       const std::vector<bool>& is_eye);

}  // namespace semblante::render

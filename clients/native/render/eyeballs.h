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

/// The data of a head's eyeballs for drawing.
struct Eyeballs {
  /// #V: position relative to the centre of the eyeball in units of its radius, w = 1; all 0 elsewhere, and without a
  /// pair of eyes. If an eye has neither a texture nor an iris part, the shader paints an iris around +Z of this frame.
  std::vector<glm::vec4> place;
  /// Bounding boxes of the left and the right eye; empty unless there are two eyes side by side.
  std::optional<std::array<Box, 2>> pair;
};

/// `is_eye`: one value per triangle.
Eyeballs find_eyeballs(std::span<const glm::vec3> positions, std::span<const Triangle> triangles,
                       const std::vector<bool>& is_eye);

}  // namespace semblante::render

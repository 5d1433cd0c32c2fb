#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "clients/native/render/camera.h"
#include "core/types/model.h"

namespace semblante::render {

/// Bounding boxes of the left and the right eye; empty unless there are two eyes side by side. `is_eye`: one value per
/// triangle.
std::optional<std::array<Box, 2>> find_eyeballs(std::span<const glm::vec3> positions,
                                                std::span<const Triangle> triangles, const std::vector<bool>& is_eye);

}  // namespace semblante::render

#pragma once

#include <glm/vec3.hpp>

#include "core/types/fapu.h"

namespace semblante {

/// Bits of quantized numbers, the same in mesh.drc and face.glb.
inline constexpr int least_position_bits = 14;  ///< of the longest side of the box
inline constexpr int most_position_bits = 24;   ///< as many as a float32 has
inline constexpr int normal_bits = 10;          ///< of each octahedral coordinate
inline constexpr int uv_bits = 12;

/// The longest side of the box that `positions` are quantized in.
float longest_side(const glm::vec3& low, const glm::vec3& high);

/// Bits of positions in a box whose longest side is `side`: so many that a step is at most two units of ES, a tenth of
/// a millimetre on an adult. One vertex that was left behind far away would else coarsen the face.
int position_bits(float side, const Fapu& fapu);

}  // namespace semblante

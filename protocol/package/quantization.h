#pragma once

namespace semblante {

/// Bits of quantized numbers, the same in mesh.drc and face.glb.
inline constexpr int position_bits = 14;  ///< of the longest side of the box
inline constexpr int normal_bits = 10;    ///< of each octahedral coordinate
inline constexpr int uv_bits = 12;

}  // namespace semblante

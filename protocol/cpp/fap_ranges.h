#pragma once

#include <cstddef>
#include <cstdint>

#include "protocol/cpp/face_frame.h"

namespace semblante {

/// The range of a FAP's levels in a stream: the standard's range, for unidirectional FAPs extended to negative values
/// (real files have them). For the standard quantizer steps times `scale`. `fap`: 3..68.
struct LevelRange {
  std::int32_t least, most;
};
LevelRange level_range(std::size_t fap, double scale = 1.0);

/// Clamps all levels to their ranges and returns the number of clamped values. All frames that enter a stream, from any
/// source, are clamped by this function.
/// `scale`: ratio of the frame's steps to the standard ones, one of quantizer_scales.
std::size_t clamp_to_ranges(FaceFrame& frame, double scale = 1.0);

}  // namespace semblante

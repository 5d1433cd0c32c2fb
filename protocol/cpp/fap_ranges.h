#pragma once

#include <cstddef>
#include <cstdint>

#include "protocol/cpp/face_frame.h"

namespace semblante {

/// Levels a FAP may have in a stream: those of the standard's table, for a unidirectional FAP also negative ones as far
/// (real files have them). For the standard quantizer steps times `scale`. `fap`: 3..68.
struct LevelRange {
  std::int32_t least, most;
};
LevelRange level_range(std::size_t fap, double scale = 1.0);

/// Brings what is beyond its range to its end. How many values that were. Everything that enters a stream goes through
/// here, wherever it comes from.
/// `scale`: of the frame's steps against the standard ones, one of quantizer_scales.
std::size_t clamp_to_ranges(FaceFrame& frame, double scale = 1.0);

}  // namespace semblante

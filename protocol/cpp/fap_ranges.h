#pragma once

#include <cstddef>
#include <cstdint>

#include "protocol/cpp/face_frame.h"

namespace semblante {

/// Levels a FAP may have in a stream: those of the standard's table, for a unidirectional FAP also negative ones as far
/// (real files have them). For the standard quantizer steps. `fap`: 3..68.
struct LevelRange {
  std::int32_t least, most;
};
LevelRange level_range(std::size_t fap);

/// Brings what is beyond its range to its end. How many values that were. Everything that enters a stream goes through
/// here, wherever it comes from.
std::size_t clamp_to_ranges(FaceFrame& frame);

}  // namespace semblante

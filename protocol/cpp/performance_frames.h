#pragma once

#include <cstddef>
#include <vector>

#include "core/performance/performance.h"
#include "core/types/result.h"
#include "protocol/cpp/face_values.h"

namespace semblante {

/// Frames per second of a performance that is written as frames, unless another rate is given.
inline constexpr double usual_frame_rate = 25.0;

/// The faces of a performance at 0, 1/rate, 2/rate, ... s, up to its duration. `rate`: above 0. Errors: missing for
/// idle life alone, which has no end; too_large for more than `most` frames. Both name /duration.
Result<std::vector<TimedValues>> frames_of(const Performance& performance, double rate, std::size_t most);

}  // namespace semblante

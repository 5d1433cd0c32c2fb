#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/speech/wav.h"
#include "core/types/result.h"

namespace semblante::voice {

/// A sound of one channel at another rate, within +-1. It is as long as the sound, to the nearest sample, so that parts
/// which are converted one by one do not drift. Error `internal`: the library's.
Result<std::vector<float>> resampled(std::span<const std::int16_t> samples, std::uint32_t from, std::uint32_t to);
Result<Recording> resampled(const Recording& sound, std::uint32_t to);

}  // namespace semblante::voice

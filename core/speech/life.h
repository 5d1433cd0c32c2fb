#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/performance/cue.h"
#include "core/speech/loudness.h"
#include "core/speech/segments.h"

namespace semblante {

/// What a face does while it speaks, beside the mouth: it blinks when a phrase ends and now and then within a long one;
/// at the loudest stressed vowel of a phrase the brows rise (not where an expression moves them) and the head nods; the
/// head lifts with the breath before a phrase; the eyes look aside as a sentence begins, and back. `liveliness` scales
/// brows, nods and turns of the head. A function of the arguments alone.
std::vector<Cue> life_cues(std::span<const Segment> segments, const Loudness& loudness,
                           std::span<const Interval> brows_taken, std::uint32_t seed, double liveliness = 1.0);

}  // namespace semblante

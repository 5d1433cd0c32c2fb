#pragma once

#include <span>
#include <vector>

#include "protocol/cpp/packed_codec.h"
#include "tests/bench/coding/traces.h"

namespace semblante::bench {

/// The probabilities that these traces have in the packed form's contexts.
PackedTable trained(std::span<const Trace> traces);

/// The trace as messages of `per_message` frames, after a keyframe of its first frame.
Keyframe first_frame(const Trace& trace);
std::vector<Frames> batches(const Trace& trace, std::size_t per_message);

}  // namespace semblante::bench

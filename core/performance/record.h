#pragma once

#include <span>

#include "core/kernel/semblante_kernel.h"
#include "core/performance/cue.h"
#include "core/types/result.h"

namespace semblante {

/// A face at a moment of a recording. Times in ms; they do not fall, and of frames at one time the last counts.
struct RecordedFrame {
  double time = 0.0;
  semblante_frame face{};
};

struct RecordingOptions {
  /// How far the performance may be from the recording at the recorded times: in quantizer steps of each FAP, and in
  /// sixty-thirds of FAPs 1 and 2.
  double tolerance = 0.5;
};

/// A performance that gives the frames back: at their times (the first becomes 0) within the tolerance, and exactly
/// rest where they are at rest. Values become keys joined by straight lines, as few as the tolerance lets a greedy walk
/// leave out; FAP 1 becomes a cue for each pair of visemes, FAP 2 cues of each expression. It ends one mean frame after
/// the last. Errors: empty; out_of_range (times fall, a value that is not finite) with the frame's pointer; too_large
/// (more cues or keys than a performance has).
Result<PerformanceScript> record_performance(std::span<const RecordedFrame> frames,
                                             const RecordingOptions& options = {});

}  // namespace semblante

#pragma once

#include <span>

#include "core/kernel/semblante_kernel.h"
#include "core/performance/cue.h"
#include "core/types/result.h"

namespace semblante {

/// A face at a moment of a recording. Times in ms, not decreasing; of several frames at one time the last is used.
struct RecordedFrame {
  double time = 0.0;
  semblante_frame face{};
};

struct RecordingOptions {
  /// Maximum difference between performance and recording at the recorded times: in quantizer steps of each FAP, and in
  /// 63rds for FAPs 1 and 2.
  double tolerance = 0.5;
};

/// Converts frames to a performance that reproduces them at their times (shifted so that the first is 0) within the
/// tolerance, and exactly at rest. Values become keys with linear easing, reduced greedily within the tolerance;
/// FAP 1 becomes one cue per run of a viseme pair, FAP 2 cues per expression. It ends one mean frame interval after
/// the last frame. Errors: empty; out_of_range (decreasing times, a value that is not finite) with the frame's pointer;
/// too_large (more cues or keys than a performance may have).
Result<PerformanceScript> record_performance(std::span<const RecordedFrame> frames,
                                             const RecordingOptions& options = {});

}  // namespace semblante

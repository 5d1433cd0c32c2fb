#pragma once

#include <cstddef>
#include <vector>

#include "core/performance/performance.h"

namespace semblante {

/// A performance that is made while it is played: parts are added at its end. The face at a time is the one of all
/// parts in one script. What has been shown stays as it was: where a part's first cues would change how the cues before
/// them end, and that has been shown already, the part begins later. One thread.
class GrowingPerformance {
 public:
  /// Adds a part that lasts `length` ms from `lead` on its own clock; cues before `lead` overlap with the part before.
  /// Its duration is not used, and the idle life is that of the first part. `shown`: the face up to this time must not
  /// change. Returns when the part begins, ms: where the part before it ends, or, too late for that, a multiple of
  /// `late_step_ms` later. Errors: those of Performance::compile().
  Result<double> add(const PerformanceScript& part, double lead, double length, double shown);
  static constexpr double late_step_ms = 10.0;

  /// Where the last part ends, ms.
  [[nodiscard]] double duration() const { return end_; }
  [[nodiscard]] semblante_frame frame_at(double ms, double idle_ms) const;
  /// Memory of the cues and keys, bytes.
  [[nodiscard]] std::size_t bytes() const;

 private:
  /// The face from a time on, until the next stretch begins.
  struct Stretch {
    double begin;
    Performance face;
  };
  std::vector<Stretch> stretches_;
  PerformanceScript newest_;  ///< of the last stretch
  double end_ = 0.0;
};

}  // namespace semblante

#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/kernel/semblante_kernel.h"
#include "core/performance/cue.h"
#include "core/performance/track.h"
#include "core/types/result.h"

namespace semblante {

/// A compiled performance: the state of the face as a function of time. Immutable: any thread.
///
/// Cues on one target are layered in the order of the script by their weights:
/// value = below + weight (cue - below). The lowest layer is rest: 0, silence, straight ahead. The targets are each
/// FAP, the viseme (one target for all visemes), each expression, each eye's blink, the look, the head.
///
/// The frame combines them: eyes and head are the sum of look, head cues and idle life (during a look, the eyes
/// compensate for the head's rotation, each at most 45 degrees sideways and 35 up or down); FAP cues are layered over
/// that; the lids close from their resulting position by the stronger of cue and idle life. FAP 1 gets the two
/// strongest of the visemes and silence, FAP 2 the two strongest expressions.
class Performance {
 public:
  /// Errors (with the JSON pointer into the document): unknown numbers, not finite, out of range, out of order, too
  /// many.
  static Result<Performance> compile(const PerformanceScript& script);

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Duration, ms; 0 for idle life only, which is endless.
  [[nodiscard]] double duration() const { return duration_; }
  [[nodiscard]] bool endless() const { return duration_ <= 0.0; }
  [[nodiscard]] std::size_t cue_count() const { return cue_count_; }
  [[nodiscard]] const std::optional<IdleLife>& idle() const { return idle_; }
  /// Memory of the cues and keys, bytes.
  [[nodiscard]] std::size_t bytes() const;

  /// The face `ms` after the start; `idle_ms` is the time of idle life, which a loop of the cues does not restart.
  /// Both not negative. No cue is active from the duration on.
  [[nodiscard]] semblante_frame frame_at(double ms, double idle_ms) const;
  [[nodiscard]] semblante_frame frame_at(double ms) const { return frame_at(ms, ms); }

 private:
  struct Look {
    double yaw, pitch;                 ///< degrees
    double eye_yaw[2], eye_pitch[2];   ///< left, right: what convergence adds, degrees
    double head_yaw, head_pitch;       ///< the head's part
    double head_attack, head_release;  ///< ms: a head is slower than eyes
  };
  struct Gaze {
    double eye_yaw[2] = {0.0, 0.0}, eye_pitch[2] = {0.0, 0.0};
    double head[3] = {0.0, 0.0, 0.0};  ///< pitch, yaw, roll
  };
  struct Compiler;

  [[nodiscard]] double value_of(const Span& span, double ms) const;
  [[nodiscard]] Gaze gaze_at(double ms) const;
  void set_viseme(double ms, semblante_frame& frame) const;
  void set_expression(double ms, semblante_frame& frame) const;

  std::string name_;
  double duration_ = 0.0;
  std::size_t cue_count_ = 0;
  std::optional<IdleLife> idle_;
  std::vector<CueKey> keys_;
  std::array<Track, SEMBLANTE_FAP_COUNT + 1> faps_;
  Track visemes_, looks_, heads_;
  std::array<Track, SEMBLANTE_EXPRESSION_COUNT> expressions_;
  std::array<Track, 2> blinks_;  ///< left, right
  std::vector<VisemeTarget> viseme_shapes_;
  std::vector<Look> look_ways_;
  std::vector<HeadTarget> head_turns_;
};

}  // namespace semblante

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

/// A performance ready to be played: the state of the face as a function of time. Immutable: any thread.
///
/// One rule joins cues on one target: in the order of the script each is laid over what is below it, by its weight:
/// value = below + weight (cue - below). Below the first is rest: 0, silence, straight ahead. The targets are each FAP,
/// the viseme (one target: FAP 1 is one mouth), each expression, each eye's blink, the look, the head.
///
/// Then the frame is put together: eyes and head from look, head cues and idle life (angles add; while a look holds,
/// the eyes keep it against the turning head, each at most 45 degrees aside and 35 up or down); FAP cues over that; the
/// lids close from where they are by the stronger of cue and idle life. FAP 1 takes the two strongest of the visemes
/// and silence, FAP 2 the two strongest expressions: a third is left out.
class Performance {
 public:
  /// Errors carry the JSON pointer into the document: unknown numbers, not finite, out of range, out of order, too
  /// many.
  static Result<Performance> compile(const PerformanceScript& script);

  [[nodiscard]] const std::string& name() const { return name_; }
  /// ms; 0 when there is nothing but idle life, which has no end.
  [[nodiscard]] double duration() const { return duration_; }
  [[nodiscard]] bool endless() const { return duration_ <= 0.0; }
  [[nodiscard]] std::size_t cue_count() const { return cue_count_; }
  [[nodiscard]] const std::optional<IdleLife>& idle() const { return idle_; }
  /// The memory of its cues and keys.
  [[nodiscard]] std::size_t bytes() const;

  /// The face `ms` after the beginning; `idle_ms` is the time of idle life, which runs on when the cues are looped.
  /// Both not negative. From the duration on no cue is active.
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

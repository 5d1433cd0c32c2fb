#pragma once

namespace semblante::viewer {

/// How pictures are drawn: the first is the best.
struct Effort {
  int samples = 4;  ///< per pixel
  int shadow_side = 2048;
};

/// Says what to make cheaper when a device cannot draw 30 pictures a second: first the shadows, then the edges, then
/// the level of detail. It never goes back, since what was too slow before would be so again.
class Pace {
 public:
  enum class Step { none, effort, smaller_level };

  /// The effort of now.
  [[nodiscard]] const Effort& effort() const { return effort_; }
  /// A picture was drawn, `seconds` after the one before; at most one step in a few seconds.
  Step tick(double seconds, bool has_smaller_level);
  /// Without trying the others first.
  void take_least();

 private:
  Effort effort_;
  double time_ = 0;
  int pictures_ = 0;
};

}  // namespace semblante::viewer

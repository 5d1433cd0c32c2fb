#pragma once

#include <array>
#include <cstddef>

namespace semblante::viewer {

/// What fingers did since the last look, as a window of `viewer/window.h` says it.
struct Gesture {
  float turn_x = 0;  ///< of a drag with one finger, in window widths to the right, and heights down
  float turn_y = 0;
  float zoom = 1;  ///< factor of the distance, of two fingers
  bool looks_front = false;
};

/// One finger turns, two zoom, two taps look at the front.
class Gestures {
 public:
  struct Finger {
    float x = 0, y = 0;  ///< of the window's width and height
  };

  /// A finger came, moved or went: the first two that now touch the screen, and their number, 0 to 2. `seconds`: of
  /// any clock.
  void touch(const std::array<Finger, 2>& fingers, std::size_t count, double seconds);
  /// What was done since the last call.
  Gesture take();

 private:
  std::array<Finger, 2> last_;
  std::size_t count_ = 0;
  Finger begin_;
  double begun_ = 0;
  double tapped_ = -1;  ///< the time of the last tap; -1: none that a second would follow
  bool is_tap_ = false;
  Gesture gesture_;
};

}  // namespace semblante::viewer

#include "clients/native/viewer/gestures.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace semblante::viewer {
namespace {

constexpr double longest_tap = 0.3;           // seconds
constexpr double longest_between_taps = 0.3;  // seconds
constexpr float widest_tap = 0.03F;           // of the window
constexpr float nearest_fingers = 0.02F;

float distance(const Gestures::Finger& a, const Gestures::Finger& b) { return std::hypot(a.x - b.x, a.y - b.y); }

}  // namespace

void Gestures::touch(const std::array<Finger, 2>& fingers, std::size_t count, double seconds) {
  if (count == 1 && count_ == 0) {
    begin_ = fingers[0];
    begun_ = seconds;
    is_tap_ = true;
  }
  is_tap_ = is_tap_ && count < 2 && (count == 0 || distance(fingers[0], begin_) < widest_tap);
  if (count == 1 && count_ == 1) {
    gesture_.turn_x += fingers[0].x - last_[0].x;
    gesture_.turn_y += fingers[0].y - last_[0].y;
  } else if (count == 2 && count_ == 2) {
    const float before = std::max(distance(last_[0], last_[1]), nearest_fingers);
    const float now = std::max(distance(fingers[0], fingers[1]), nearest_fingers);
    gesture_.zoom *= before / now;
  } else if (count == 0 && count_ == 1 && is_tap_ && seconds - begun_ <= longest_tap) {
    const bool is_second = tapped_ >= 0 && begun_ - tapped_ <= longest_between_taps;
    gesture_.looks_front = gesture_.looks_front || is_second;
    tapped_ = is_second ? -1 : seconds;
  }
  last_ = fingers;
  count_ = count;
}

Gesture Gestures::take() { return std::exchange(gesture_, {}); }

}  // namespace semblante::viewer

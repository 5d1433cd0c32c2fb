#include "clients/native/viewer/pace.h"

namespace semblante::viewer {
namespace {

constexpr double slowest = 28;        // pictures a second: 30, with what timers are late
constexpr double measured = 2.0;      // seconds
constexpr double interruption = 0.5;  // longer than that nothing was drawn, such as while a level was loaded
constexpr Effort least{1, 512};

}  // namespace

Pace::Step Pace::tick(double seconds, bool has_smaller_level) {
  if (seconds > interruption && pictures_ > 0) {
    time_ = 0;
    pictures_ = 0;
    return Step::none;
  }
  time_ += seconds;
  ++pictures_;
  if (time_ < measured) {
    return Step::none;
  }
  const bool is_slow = pictures_ / time_ < slowest;
  time_ = 0;
  pictures_ = 0;
  if (!is_slow) {
    return Step::none;
  }
  if (effort_.shadow_side > least.shadow_side) {
    effort_.shadow_side = least.shadow_side;
    return Step::effort;
  }
  if (effort_.samples > least.samples) {
    effort_.samples = least.samples;
    return Step::effort;
  }
  return has_smaller_level ? Step::smaller_level : Step::none;
}

void Pace::take_least() { effort_ = least; }

}  // namespace semblante::viewer

#include "core/frame/frame_guess.h"
#include "core/geometry/rotation.h"

namespace semblante {
namespace {

/// The front after the smallest rotation of an upright head: about X for up along Z, about Z for up along X or down.
Direction front_of(Direction up) {
  if (axis_of(up) != 2) return Direction::plus_z;
  return up == Direction::plus_z ? Direction::minus_y : Direction::plus_y;
}

Direction up_of(Direction front) { return axis_of(front) == 1 ? Direction::plus_z : Direction::plus_y; }

}  // namespace

glm::dmat3 turn_upright(const ModelFrame& frame) { return frame.tilt * to_mpeg4(frame.axes); }

double tilt_of(const ModelFrame& frame) { return degrees_of(frame.tilt); }

ModelFrame apply_wish(ModelFrame guess, const FrameWish& wish) {
  if (wish.unit) {
    guess.unit = *wish.unit;
    guess.unit_sure = true;
    guess.reasons.push_back("The unit is " + std::string(to_string(guess.unit)) + ", as set by the user");
  }
  if (!wish.has_axes()) return guess;
  Axes axes{wish.up.value_or(guess.axes.up), wish.front.value_or(guess.axes.front)};
  if (!are_valid(axes)) axes = wish.up ? Axes{*wish.up, front_of(*wish.up)} : Axes{up_of(*wish.front), *wish.front};
  if (guess.axes_sure && guess.axes != axes) {
    guess.reasons.push_back("The shape indicates " + std::string(to_string(guess.axes.up)) +
                            " up and the face towards " + std::string(to_string(guess.axes.front)) +
                            ", but the user set other axes");
  }
  guess.axes = axes;
  guess.axes_sure = true;
  guess.tilt = glm::dmat3(1.0);
  guess.reasons.push_back("The head stands along " + std::string(to_string(axes.up)) + " and faces " +
                          std::string(to_string(axes.front)) + ", as set by the user");
  return guess;
}

}  // namespace semblante

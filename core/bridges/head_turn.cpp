#include "core/bridges/head_turn.h"

#include <algorithm>

#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

constexpr std::size_t head_pitch = 48;
constexpr std::size_t head_yaw = 49;
constexpr std::size_t head_roll = 50;

/// FAPs 23, 24 and 49 are positive to the face's left, so a yaw to the right is negative; 25, 26 and 48 are positive
/// down; 50 towards the right shoulder.
void set_angle(semblante_frame& frame, std::size_t number, double radians) {
  const mpeg4::Fap& fap = mpeg4::fap(number);
  const double units = radians / mpeg4::radians_per_au;
  frame.fap[number] =
      static_cast<float>(std::clamp(units, static_cast<double>(fap.min()), static_cast<double>(fap.max())));
}

float angle(const semblante_frame& frame, std::size_t number) {
  return static_cast<float>(static_cast<double>(frame.fap[number]) * mpeg4::radians_per_au);
}

}  // namespace

void turn_head(semblante_frame& frame, const HeadTurn& turn) {
  set_angle(frame, head_yaw, -static_cast<double>(turn.yaw));
  set_angle(frame, head_pitch, static_cast<double>(turn.pitch));
  set_angle(frame, head_roll, static_cast<double>(turn.roll));
}

HeadTurn head_turn_of(const semblante_frame& frame) {
  return {-angle(frame, head_yaw), angle(frame, head_pitch), angle(frame, head_roll)};
}

EyeTurn left_eye_turn_of(const semblante_frame& frame) { return {-angle(frame, 23), angle(frame, 25)}; }
EyeTurn right_eye_turn_of(const semblante_frame& frame) { return {-angle(frame, 24), angle(frame, 26)}; }

}  // namespace semblante

#pragma once

#include "core/kernel/semblante_kernel.h"

namespace semblante {

/// How a head is turned, as Live Link Face sends it beside the 52: radians; yaw is positive towards the face's right,
/// pitch is positive down, roll is positive towards the face's right shoulder.
struct HeadTurn {
  float yaw = 0.0F;
  float pitch = 0.0F;
  float roll = 0.0F;
};

/// Sets FAPs 48 to 50, within their ranges. The angles must be finite.
void turn_head(semblante_frame& frame, const HeadTurn& turn);
HeadTurn head_turn_of(const semblante_frame& frame);

/// The eyes' angles that Live Link Face sends as well, in the same sense. They say what the eyeLook coefficients say,
/// so they are written and never read.
struct EyeTurn {
  float yaw = 0.0F;
  float pitch = 0.0F;
};
EyeTurn left_eye_turn_of(const semblante_frame& frame);
EyeTurn right_eye_turn_of(const semblante_frame& frame);

}  // namespace semblante

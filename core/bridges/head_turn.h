#pragma once

#include "core/kernel/semblante_kernel.h"

namespace semblante {

/// The rotation of the head, as Live Link Face sends it beside the 52 coefficients: radians; yaw is positive towards
/// the face's right, pitch is positive down, roll is positive towards the face's right shoulder.
struct HeadTurn {
  float yaw = 0.0F;
  float pitch = 0.0F;
  float roll = 0.0F;
};

/// Sets FAPs 48 to 50, within their ranges. The angles must be finite.
void turn_head(semblante_frame& frame, const HeadTurn& turn);
HeadTurn head_turn_of(const semblante_frame& frame);

/// The angles of the eyes that Live Link Face also sends, with the same signs. They repeat the eyeLook coefficients, so
/// they are written but not read.
struct EyeTurn {
  float yaw = 0.0F;
  float pitch = 0.0F;
};
EyeTurn left_eye_turn_of(const semblante_frame& frame);
EyeTurn right_eye_turn_of(const semblante_frame& frame);

}  // namespace semblante

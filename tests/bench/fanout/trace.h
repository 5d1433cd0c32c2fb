#pragma once

#include <cstdint>

#include "protocol/cpp/face_frame.h"

namespace semblante::bench {

/// What the bench's publisher sends: a face that talks, looks and blinks; `heavy`, one that changes all of its FAPs in
/// every frame, for messages of many bytes. A function of the frame's number alone, so that who receives frame n knows
/// what it must be.
FaceFrame trace_frame(std::uint64_t number, bool heavy);

}  // namespace semblante::bench

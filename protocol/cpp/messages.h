#pragma once

// The stream messages as plain structs: Hello, Header, Keyframe, Frames, End, StreamError, Ping, Pong; `Message` is
// their variant. Generated from protocol/schema/messages.json; protocol/SPEC.md defines their meaning.

#include "core/types/result.h"
#include "protocol/cpp/face_frame.h"
#include "protocol/cpp/generated/messages.h"

namespace semblante {

/// Converts an error in a peer's message to the `error` message: same text, code by name.
StreamError to_stream_error(const Error& error);

}  // namespace semblante

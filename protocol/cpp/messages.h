#pragma once

// The stream messages as plain structs: Hello, Header, Keyframe, Frames, End, StreamError, Ping, Pong; `Message` is any
// of them. They are generated from protocol/schema/messages.json; their meaning is in protocol/SPEC.md.

#include "core/types/result.h"
#include "protocol/cpp/face_frame.h"
#include "protocol/cpp/generated/messages.h"

namespace semblante {

/// What a peer is told about an error found in its message: same words, the code by name.
StreamError to_stream_error(const Error& error);

}  // namespace semblante

#pragma once

#include <chrono>
#include <cstddef>
#include <span>

#include "clients/native/client/live_stream.h"
#include "core/types/result.h"
#include "protocol/cpp/face_frame.h"

namespace semblante::tools {

/// Sends frames at their own times. `stream` must have the role publish; its header is waited for as long as
/// `patience`. Returns the number of sent frames. Errors: the server's error messages; io, also for a connection that
/// was lost, as frames were lost with it.
Result<std::size_t> publish_frames(client::LiveStream& stream, std::span<const TimedFrame> frames,
                                   std::chrono::milliseconds patience);

}  // namespace semblante::tools

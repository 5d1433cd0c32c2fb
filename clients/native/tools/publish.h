#pragma once

#include <chrono>
#include <cstddef>
#include <string_view>

#include "clients/native/client/live_stream.h"
#include "core/types/result.h"

namespace semblante::tools {

/// Sends the frames of a performance ({"frames": [{"time", "viseme", "expression", "faps"}, ...]}) at their own times.
/// `stream` must have the role publish; its header is waited for as long as `patience`. Returns the number of sent
/// frames. Errors: an invalid document, with a JSON pointer; the server's error messages; io, also for a connection
/// that was lost, as frames were lost with it.
Result<std::size_t> publish_frames(client::LiveStream& stream, std::string_view json,
                                   std::chrono::milliseconds patience);

}  // namespace semblante::tools

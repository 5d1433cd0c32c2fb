#pragma once

#include <chrono>
#include <cstddef>
#include <string_view>

#include "clients/native/client/stream_client.h"
#include "core/types/result.h"

namespace semblante::tools {

/// Sends the frames of a performance ({"frames": [{"time", "viseme", "expression", "faps"}, ...]}) at their own times.
/// `stream` has the role publish. Returns how many were sent. Errors: those of the text, with a pointer; the server's
/// error messages; io.
Result<std::size_t> publish_frames(client::StreamClient& stream, std::string_view json);

}  // namespace semblante::tools

#pragma once

#include <chrono>
#include <cstddef>
#include <string_view>

#include "clients/native/client/stream_client.h"
#include "core/types/result.h"

namespace semblante::tools {

/// Sends the frames of a performance ({"frames": [{"time", "viseme", "expression", "faps"}, ...]}) at their own times.
/// `stream` must have the role publish. Returns the number of sent frames. Errors: an invalid document, with a JSON
/// pointer; the server's error messages; io.
Result<std::size_t> publish_frames(client::StreamClient& stream, std::string_view json);

}  // namespace semblante::tools

#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "server/metrics/histogram.h"

namespace semblante::http {

/// Bytes to be sent over a WebSocket: headers and payloads of one or several messages, unmasked (RFC 6455 section 5.2).
/// Immutable once shared: any number of connections send the same bytes.
struct WireMessage {
  std::string bytes;
  std::chrono::steady_clock::time_point due{};           ///< deadline for sending it
  std::shared_ptr<metrics::LatenessHistogram> lateness;  ///< receives its lateness when it had to wait; may be null
};
using SharedWire = std::shared_ptr<const WireMessage>;

/// One complete message, in one frame.
void append_message(std::string& wire, std::string_view payload, bool binary);
SharedWire make_wire(std::string_view payload, bool binary);

}  // namespace semblante::http

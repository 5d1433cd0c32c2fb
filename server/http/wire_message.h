#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "server/metrics/histogram.h"

namespace semblante::http {

/// What goes over a WebSocket as it goes: headers and payloads of one message or several, unmasked (RFC 6455 section
/// 5.2). Never changed once it is shared: any number of connections send the same bytes.
struct WireMessage {
  std::string bytes;
  std::chrono::steady_clock::time_point due{};           ///< when it should have been sent
  std::shared_ptr<metrics::LatenessHistogram> lateness;  ///< where it counts when it had to wait; null: nowhere
};
using SharedWire = std::shared_ptr<const WireMessage>;

/// One whole message, in one frame.
void append_message(std::string& wire, std::string_view payload, bool binary);
SharedWire make_wire(std::string_view payload, bool binary);

}  // namespace semblante::http

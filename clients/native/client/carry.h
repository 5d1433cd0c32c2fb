#pragma once

#include "clients/native/client/stream_client.h"
#include "clients/runtime/stream.h"

namespace semblante::client {

/// Sends all that a stream has to send.
inline Status send_all(runtime::Stream& from, StreamClient& to, bool as_text) {
  while (true) {
    const auto bytes = from.outbox().take();
    if (bytes.empty()) return Unit{};
    auto sent = to.send_raw({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, as_text);
    if (!sent) return sent;
  }
}

}  // namespace semblante::client

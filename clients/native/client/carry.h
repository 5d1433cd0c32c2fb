#pragma once

#include "clients/native/client/stream_socket.h"
#include "clients/runtime/stream.h"

namespace semblante::client {

/// Sends all that a stream has to send.
inline Status send_all(runtime::Stream& from, StreamSocket& to) {
  while (true) {
    const auto bytes = from.outbox().take();
    if (bytes.empty()) return Unit{};
    if (auto sent = to.send(bytes); !sent) return sent;
  }
}

}  // namespace semblante::client

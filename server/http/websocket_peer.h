#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "server/http/feed.h"

namespace semblante::http {

/// Why a WebSocket is closed by us: a code of RFC 6455 section 7.4 and a few words.
struct CloseReason {
  std::uint16_t code = 1000;
  std::string text;
};

/// The far side of one WebSocket as plain values. The connection owns it (shared with the one who made it); receive()
/// and take() are called on the connection's strand only, wake from anywhere.
class WebSocketPeer : public Feed {
 public:
  /// The subprotocol to echo; empty when the client offered none of ours.
  [[nodiscard]] virtual std::string_view subprotocol() const = 0;
  /// A longer message closes the connection.
  [[nodiscard]] virtual std::size_t max_message_bytes() const = 0;
  /// One whole message from the client.
  virtual void receive(std::string_view bytes, bool binary) = 0;
  /// Meaningful once finished().
  [[nodiscard]] virtual CloseReason close_reason() const = 0;
  /// The connection is gone; nothing of ours is called after this.
  virtual void disconnected() = 0;
};

}  // namespace semblante::http

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "server/http/wire_message.h"

namespace semblante::http {

/// Why a WebSocket is closed by us: a code of RFC 6455 section 7.4 and a few words.
struct CloseReason {
  std::uint16_t code = 1000;
  std::string text;
};

/// What may wait for one connection whose client does not read.
struct OutboxLimits {
  std::size_t messages = 16;           ///< of state
  std::size_t bytes = 256 * 1024;      ///< of state; one message may be longer
  std::size_t answers = 256;           ///< of messages in all
  std::size_t answer_bytes = 1 << 20;  ///< of all
};

enum class Sent : std::uint8_t {
  handed,   ///< the kernel has it
  waits,    ///< it will go when the client reads
  refused,  ///< too much waits already: it was not taken
  closed,   ///< the connection is closed or closing
};

/// `state` may be replaced by newer state, an `answer` is the client's own.
enum class Purpose : std::uint8_t { state, answer };

/// Where a peer sends. Any thread; never waits for the client. What is sent first arrives first.
class WebSocketSink {
 public:
  virtual ~WebSocketSink() = default;
  virtual Sent send(const SharedWire& message, Purpose purpose) = 0;
  /// Forgets waiting state, but for a message that has gone in part; how many messages that were.
  virtual std::size_t drop_state() = 0;
  /// Nothing waits, and WebSocketPeer::writable is not about to be called.
  [[nodiscard]] virtual bool idle() const = 0;
  /// Since when the client has taken nothing although something waits.
  [[nodiscard]] virtual std::optional<std::chrono::steady_clock::time_point> stalled_since() const = 0;
  /// Sends `last` (may be null) behind what waits, then closes; later messages are not taken. A client that does not
  /// read is cut off after a while. The first call counts.
  virtual void close(CloseReason reason, const SharedWire& last) = 0;
};

/// The far side of one WebSocket as plain values. The connection owns it (shared with the one who made it) and calls it
/// on its own strand only.
class WebSocketPeer {
 public:
  virtual ~WebSocketPeer() = default;
  /// The subprotocol to echo; empty when the client offered none of ours.
  [[nodiscard]] virtual std::string_view subprotocol() const = 0;
  /// A longer message closes the connection.
  [[nodiscard]] virtual std::size_t max_message_bytes() const = 0;
  [[nodiscard]] virtual OutboxLimits outbox_limits() const = 0;
  /// The handshake is done: from here on the peer may send. Once, before all that follows.
  virtual void attach(std::shared_ptr<WebSocketSink> sink) = 0;
  /// One whole message from the client.
  virtual void receive(std::string_view bytes, bool binary) = 0;
  /// All that waited has gone.
  virtual void writable() = 0;
  /// The connection is gone; nothing of ours is called after this. Also without attach, when the handshake failed.
  virtual void disconnected() = 0;
};

}  // namespace semblante::http

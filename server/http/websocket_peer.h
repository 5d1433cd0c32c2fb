#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "server/http/wire_message.h"

namespace semblante::http {

/// The reason for which the server closes a WebSocket: a code of RFC 6455 section 7.4 and a short text.
struct CloseReason {
  std::uint16_t code = 1000;
  std::string text;
};

/// Limits of the messages that wait for one connection whose client does not read.
struct OutboxLimits {
  std::size_t messages = 16;                    ///< of state
  std::size_t bytes = std::size_t{256} * 1024;  ///< of state; one message may be longer
  std::size_t answers = 256;                    ///< of all messages
  std::size_t answer_bytes = 1 << 20;           ///< of all
};

enum class Sent : std::uint8_t {
  handed,   ///< accepted by the kernel
  waits,    ///< to be sent when the client reads
  refused,  ///< not accepted: too many messages wait already
  closed,   ///< the connection is closed or closing
};

/// `state` may be replaced by newer state, an `answer` may not.
enum class Purpose : std::uint8_t { state, answer };

/// Sends the messages of a peer, in order. Any thread; never waits for the client.
class WebSocketSink {
 public:
  virtual ~WebSocketSink() = default;
  virtual Sent send(const SharedWire& message, Purpose purpose) = 0;

  /// send() of state in two steps, for one who hands over the messages of many connections together. If `descriptor` is
  /// not negative, the caller hands the bytes to it and then calls end_send(); until then nobody else writes to it, and
  /// it stays open. Otherwise `sent` is the result. The caller holds `handing` from before begin_send() to after
  /// end_send().
  struct SendStep {
    int descriptor = -1;
    Sent sent = Sent::refused;
  };
  virtual SendStep begin_send(const SharedWire& message, std::mutex& /*handing*/) {
    return {-1, send(message, Purpose::state)};
  }
  /// `result`: how many bytes the kernel accepted, or -errno.
  virtual Sent end_send(const SharedWire& /*message*/, long /*result*/) { return Sent::closed; }

  /// Drops waiting state, except for a partly sent message; returns the number of dropped messages.
  virtual std::size_t drop_state() = 0;
  /// True when nothing waits, and no call of WebSocketPeer::writable is pending.
  [[nodiscard]] virtual bool idle() const = 0;
  /// Since when the client has read nothing although messages wait.
  [[nodiscard]] virtual std::optional<std::chrono::steady_clock::time_point> stalled_since() const = 0;
  /// Sends `last` (may be null) after the waiting messages, then closes; later messages are refused. A client that does
  /// not read is disconnected at a deadline. Only the first call has an effect.
  virtual void close(CloseReason reason, const SharedWire& last) = 0;
};

/// The application's side of one WebSocket. Shared by the connection, which calls it on its strand only, and by its
/// creator.
class WebSocketPeer {
 public:
  virtual ~WebSocketPeer() = default;
  /// The subprotocol to echo; empty when the client offered no supported one.
  [[nodiscard]] virtual std::string_view subprotocol() const = 0;
  /// A longer message closes the connection.
  [[nodiscard]] virtual std::size_t max_message_bytes() const = 0;
  [[nodiscard]] virtual OutboxLimits outbox_limits() const = 0;
  /// The handshake is complete: from now on the peer may send. Called once, before all calls below.
  virtual void attach(std::shared_ptr<WebSocketSink> sink) = 0;
  /// One complete message from the client.
  virtual void receive(std::string_view bytes, bool binary) = 0;
  /// All waiting messages have been sent.
  virtual void writable() = 0;
  /// The connection is closed; no call follows. Also called without attach, when the handshake failed.
  virtual void disconnected() = 0;
};

}  // namespace semblante::http

#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "server/http/websocket_peer.h"
#include "server/net/tls_session.h"

namespace semblante::net {

/// Interface through which an Outbox requests work on the connection's strand. Called from any thread, without the
/// outbox's mutex.
class OutboxOwner {
 public:
  virtual ~OutboxOwner() = default;
  /// The socket's send buffer is full: wait until it is writable, then flush().
  virtual void on_blocked() = 0;
  /// The peer closes the connection: send a close frame with this reason, by send_control().
  virtual void on_close(const http::CloseReason& reason) = 0;
  /// Strand only. Both sides have sent their close frames; only the socket is still open.
  virtual void on_over() = 0;
};

/// The only writer of a WebSocket: messages of the peer, from any thread, and control frames, from the strand, are sent
/// in the order of their calls. The calling thread writes a message directly to the socket; only bytes that the kernel
/// does not accept are kept, and sent when the socket is writable again. So a client that reads costs no queue, no
/// wake-up and no copy.
///
/// The descriptor is not owned. It must be a stream socket, and detach() must be called before it is closed: a later
/// send does not use the descriptor, which may belong to another connection by then.
class Outbox : public http::WebSocketSink {
 public:
  /// `tls`: what encrypts for that socket; null for a plain one.
  Outbox(int descriptor, http::OutboxLimits limits, std::weak_ptr<OutboxOwner> owner,
         std::shared_ptr<TlsSession> tls = nullptr)
      : descriptor_(descriptor), tls_(std::move(tls)), owner_(std::move(owner)), limits_(limits) {}

  // ---- the peer's side: any thread
  http::Sent send(const http::SharedWire& message, http::Purpose purpose) override;
  SendStep begin_send(const http::SharedWire& message, std::mutex& handing) override;
  http::Sent end_send(const http::SharedWire& message, long result) override;
  std::size_t drop_state() override;
  [[nodiscard]] bool idle() const override;
  [[nodiscard]] std::optional<std::chrono::steady_clock::time_point> stalled_since() const override;
  void close(http::CloseReason reason, const http::SharedWire& last) override;

  // ---- the connection's side: its strand
  /// What the WebSocket protocol itself sends (handshake, ping, pong, close). Never refused. After a close frame no
  /// message of the peer is sent.
  http::Sent send_control(std::string bytes);
  enum class Flushed { all, some, closed };
  /// Sends the waiting bytes. `some`: wait for the socket again, then call again.
  Flushed flush();
  /// No later send uses the descriptor; waiting messages are dropped.
  void detach();
  /// The closing handshake is done: calls detach() and notifies the owner.
  void finish();
  [[nodiscard]] bool detached() const;

 private:
  enum class Kind : std::uint8_t { state, answer, control };
  struct Item {
    http::SharedWire message;
    Kind kind;
  };
  /// Allocated only while messages wait: most connections never need it.
  struct Waiting {
    std::deque<Item> items;
    std::size_t sent_of_first = 0;  ///< bytes
    std::size_t state_messages = 0, state_bytes = 0, bytes = 0;
    std::chrono::steady_clock::time_point progress;  ///< when the kernel last accepted bytes
  };

  http::Sent send(const http::SharedWire& message, Kind kind, std::unique_lock<std::mutex>& lock);
  /// What the kernel has not accepted of a message that was handed to it goes first.
  http::Sent settle(const http::SharedWire& message, Kind kind, std::optional<std::size_t> handed,
                    std::unique_lock<std::mutex>& lock);
  void ask_for_flush(std::unique_lock<std::mutex>& lock);
  [[nodiscard]] bool has_room(Kind kind, std::size_t bytes) const;
  void count(const Item& item, bool comes);
  /// Number of these bytes that the kernel accepted; nullopt: the connection is closed.
  std::optional<std::size_t> hand(std::string_view bytes);
  std::optional<std::size_t> hand_encrypted(std::string_view bytes);
  void fail();

  // The members used by every send come first, in few cache lines: there are thousands of outboxes.
  mutable std::mutex mutex_;  ///< guards the members below
  int descriptor_;
  bool closing_ = false;           ///< messages of the peer are refused
  bool close_framed_ = false;      ///< a close frame was sent; nothing may follow
  bool armed_ = false;             ///< flush() will be called
  std::mutex* handing_ = nullptr;  ///< between begin_send() and end_send(): held by the caller of both
  std::unique_ptr<Waiting> waiting_;
  // Never changed.
  const std::shared_ptr<TlsSession> tls_;
  const std::weak_ptr<OutboxOwner> owner_;
  const http::OutboxLimits limits_;
};

}  // namespace semblante::net

#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "server/http/websocket_peer.h"

namespace semblante::net {

/// Who is told what an Outbox needs done on the connection's strand. Called from any thread, without the outbox's
/// mutex.
class OutboxOwner {
 public:
  virtual ~OutboxOwner() = default;
  /// The kernel takes no more: wait until the socket is writable, then flush().
  virtual void on_blocked() = 0;
  /// The peer wants it closed: send a close frame with this reason, by send_control().
  virtual void on_close(const http::CloseReason& reason) = 0;
  /// Strand only. Both sides have said that it is over; only the socket is still to be closed.
  virtual void on_over() = 0;
};

/// The one writer of a WebSocket: messages of the peer, from any thread, and control frames, from the strand, go to the
/// socket in the order they come here. A message goes to the kernel at once, by the thread that brings it; only what
/// the kernel does not take is kept, and sent when the socket is writable again. So a client that reads costs no queue,
/// no wake-up and no copy.
///
/// The descriptor is not owned. It must be a stream socket, and detach() must be called before it is closed: a send
/// after that touches no descriptor, so never one that was given to somebody else meanwhile.
class Outbox : public http::WebSocketSink {
 public:
  Outbox(int descriptor, http::OutboxLimits limits, std::weak_ptr<OutboxOwner> owner)
      : descriptor_(descriptor), owner_(std::move(owner)), limits_(limits) {}

  // ---- the peer's side: any thread
  http::Sent send(const http::SharedWire& message, http::Purpose purpose) override;
  std::size_t drop_state() override;
  [[nodiscard]] bool idle() const override;
  [[nodiscard]] std::optional<std::chrono::steady_clock::time_point> stalled_since() const override;
  void close(http::CloseReason reason, const http::SharedWire& last) override;

  // ---- the connection's side: its strand
  /// What the WebSocket protocol itself sends (handshake, ping, pong, close). Never refused. After a close frame
  /// nothing of the peer's goes out.
  http::Sent send_control(std::string bytes);
  enum class Flushed { all, some, closed };
  /// Sends what waits. `some`: wait for the socket again, then call again.
  Flushed flush();
  /// No send reaches the descriptor from here on; what waits is forgotten.
  void detach();
  /// The closing handshake is done: detach(), and the owner hears of it.
  void finish();
  [[nodiscard]] bool detached() const;

 private:
  enum class Kind : std::uint8_t { state, answer, control };
  struct Item {
    http::SharedWire message;
    Kind kind;
  };
  /// There only while something waits: most connections never need it.
  struct Waiting {
    std::deque<Item> items;
    std::size_t sent_of_first = 0;  ///< bytes
    std::size_t state_messages = 0, state_bytes = 0, bytes = 0;
    std::chrono::steady_clock::time_point progress;  ///< when the kernel last took anything
  };

  http::Sent send(const http::SharedWire& message, Kind kind, std::unique_lock<std::mutex>& lock);
  [[nodiscard]] bool has_room(Kind kind, std::size_t bytes) const;
  void count(const Item& item, bool comes);
  /// What the kernel took of these bytes; nullopt: the connection is gone.
  std::optional<std::size_t> hand(std::string_view bytes);
  void fail();

  // What every send touches comes first, side by side: there are thousands of these, and none is in the cache.
  mutable std::mutex mutex_;  ///< guards what follows
  int descriptor_;
  bool closing_ = false;       ///< the peer's messages are not taken any more
  bool close_framed_ = false;  ///< nothing may follow
  bool armed_ = false;         ///< flush() will be called
  std::unique_ptr<Waiting> waiting_;
  // Never changed.
  const std::weak_ptr<OutboxOwner> owner_;
  const http::OutboxLimits limits_;
};

}  // namespace semblante::net

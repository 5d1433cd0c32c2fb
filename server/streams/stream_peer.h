#pragma once

// The two interfaces between a stream and its connections, one for each direction.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/quantizers.h"
#include "server/http/websocket_peer.h"
#include "server/streams/source_arbiter.h"

namespace semblante::streams {

/// What the client of a connection may do.
struct ConnectionRights {
  bool may_publish = true;
  std::shared_ptr<const std::atomic<bool>> ended = nullptr;  ///< becomes true when the client's token ends; may be null
};

/// Stream to connection.
class StreamPeer {
 public:
  explicit StreamPeer(ConnectionRights rights = {}) : rights_(std::move(rights)) {}
  static constexpr std::size_t nowhere = SIZE_MAX;
  /// Data of the stream for each connection, so that it needs no map. Guarded by the stream's mutex.
  struct Notes {
    std::size_t client = nowhere;      ///< index in the stream's ClientList
    std::size_t subscriber = nowhere;  ///< index in the FanOut's SubscriberList
    SourceArbiter::Ticket ticket = 0;  ///< of a publisher
    bool said_hello = false;
  };

  virtual ~StreamPeer() = default;
  /// Sends a last message, then closes; false when it was closing already. Any thread, also with the stream's mutex
  /// held: it must not call the stream.
  virtual bool close(const Message& last, http::CloseReason reason) = 0;
  [[nodiscard]] Notes& notes() { return notes_; }
  [[nodiscard]] bool may_publish() const { return rights_.may_publish; }
  [[nodiscard]] bool rights_ended() const { return rights_.ended && *rights_.ended; }

 private:
  const ConnectionRights rights_;
  Notes notes_;
};

/// Connection to stream: constants, and the events of a connection. Any thread.
class StreamAccess {
 public:
  virtual ~StreamAccess() = default;

  /// FAP units per level.
  [[nodiscard]] virtual const QuantizerSteps& steps() const = 0;
  [[nodiscard]] virtual http::OutboxLimits outbox_limits() const = 0;
  /// ms since the stream began.
  [[nodiscard]] virtual std::uint64_t media_time_now() const = 0;

  /// A hello of a subscriber: sends the header, then the join point or the gap since the hello's resume point; then
  /// follow the batches closed from now on. `sink` is valid as long as the client.
  virtual void subscribe(StreamPeer& client, http::WebSocketSink& sink, const Hello& hello, bool binary) = 0;
  /// A hello of a publisher: returns its header. Errors: `mismatch` when another source holds the stream and
  /// `take_over` is not set, `missing` when the stream has ended.
  virtual Result<Header> begin_publishing(StreamPeer& client, const Hello& hello) = 0;
  /// Publishes frames; `media_time` is by the publisher's clock, 0: now. nullopt when they are accepted.
  virtual std::optional<SourceArbiter::Refusal> publish(StreamPeer& client, std::uint64_t media_time,
                                                        const std::vector<TimedFrame>& frames) = 0;
  /// Publishes a packet of sound; its media time is by the publisher's clock. Errors: those of
  /// SourceArbiter::place_sound(), `missing` when the stream has ended.
  virtual Status publish_sound(StreamPeer& client, SoundPacket sound) = 0;
  /// A publisher has finished; the next one can start before its socket is closed.
  virtual void end_publishing(StreamPeer& client) = 0;
  /// The client's outbox is empty: the kernel has all messages.
  virtual void writable(StreamPeer& client) = 0;
  /// The socket is closed. No event follows.
  virtual void leave(StreamPeer& client) = 0;
  /// What a subscriber's own voice does. Errors: `out_of_range`, a text that was never sent; `invalid_argument`, a
  /// client that gets frames.
  virtual Status spoken(StreamPeer& client, const Spoken& spoken) = 0;
  /// Whether a subscriber gets the text of speech beside its frames.
  virtual void show_captions(StreamPeer& client, bool on) = 0;
  /// An answer was dropped because the client has not read many earlier ones.
  virtual void answer_dropped() = 0;
};

}  // namespace semblante::streams

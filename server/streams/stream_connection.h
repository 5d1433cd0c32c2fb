#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/messages.h"
#include "server/http/websocket_peer.h"
#include "server/streams/stream.h"

namespace semblante::streams {

/// What one WebSocket of a stream has said, and how it is answered. Owned by the stream and by net's connection. There
/// are thousands of them and most only listen: what only publishers need is made when one publishes.
class StreamConnection : public http::WebSocketPeer {
 public:
  /// Its places in the stream's lists; the stream's mutex guards them.
  struct Slots {
    std::size_t connection = Subscriber::nowhere, subscriber = Subscriber::nowhere;
  };

  StreamConnection(std::shared_ptr<Stream> stream, bool binary, bool subprotocol_offered);
  ~StreamConnection() override;
  StreamConnection(const StreamConnection&) = delete;
  StreamConnection& operator=(const StreamConnection&) = delete;

  // ---- net's side: on the connection's strand
  [[nodiscard]] std::string_view subprotocol() const override;
  [[nodiscard]] std::size_t max_message_bytes() const override;
  [[nodiscard]] http::OutboxLimits outbox_limits() const override;
  void attach(std::shared_ptr<http::WebSocketSink> sink) override;
  void receive(std::string_view bytes, bool binary) override;
  void writable() override;
  void disconnected() override;

  // ---- the stream's side: any thread
  [[nodiscard]] bool binary() const { return binary_; }
  [[nodiscard]] bool said_hello() const { return role_ != Role::unknown; }
  [[nodiscard]] bool closing() const { return closing_; }
  [[nodiscard]] std::chrono::steady_clock::time_point began() const { return began_; }
  /// Not before attach().
  [[nodiscard]] http::WebSocketSink* sink() const { return sink_.get(); }
  [[nodiscard]] Slots& slots() { return slots_; }
  /// A message of its own, never replaced by newer state. Encodes it.
  void send(const Message& message);
  /// Says a last thing, then closes.
  void close(const std::optional<Message>& last, http::CloseReason reason);

 private:
  enum class Role : std::uint8_t { unknown, subscribes, publishes };
  struct Publishing;

  void refuse(StreamErrorCode code, std::string where, std::string message);
  void handle(Message message);
  void handle_hello(const Hello& hello);
  void handle_frames(std::uint64_t media_time, const std::vector<TimedFrame>& frames);
  /// Whether so many more frames may come now; says so when they may not.
  bool admit(std::size_t frames);

  const std::shared_ptr<Stream> stream_;
  const bool binary_;
  const bool subprotocol_offered_;
  std::atomic<bool> closing_{false};
  std::atomic<Role> role_{Role::unknown};
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::unique_ptr<Publishing> publishing_;  ///< strand only
  Slots slots_;

  struct LastWords {
    http::SharedWire last;
    http::CloseReason reason;
  };
  std::mutex mutex_;  ///< guards setting the sink and closing before there is one
  std::shared_ptr<http::WebSocketSink> sink_;
  std::unique_ptr<LastWords> last_words_;
};

}  // namespace semblante::streams

#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/messages.h"
#include "server/http/websocket_peer.h"
#include "server/streams/stream.h"

namespace semblante::streams {

/// What one WebSocket of a stream has said and still has to hear. Owned by the stream and by net's connection;
/// receive() and take() run on the connection's strand, everything else from any thread under the mutex.
class StreamConnection : public http::WebSocketPeer {
 public:
  StreamConnection(std::shared_ptr<Stream> stream, bool binary, bool subprotocol_offered);

  // ---- net's side
  void attach(std::function<void()> wake) override;
  std::optional<http::FeedItem> take() override;
  [[nodiscard]] bool finished() const override;
  [[nodiscard]] std::string_view subprotocol() const override;
  [[nodiscard]] std::size_t max_message_bytes() const override;
  void receive(std::string_view bytes, bool binary) override;
  [[nodiscard]] http::CloseReason close_reason() const override;
  void disconnected() override;

  // ---- the stream's side; called with the stream's mutex held
  [[nodiscard]] bool binary() const { return binary_; }
  [[nodiscard]] bool subscribed() const;
  [[nodiscard]] bool said_hello() const;
  [[nodiscard]] bool closing() const { return finished(); }
  void set_subscribed();
  /// Queues one message. What does not fit is dropped, and the newest state takes the place of all that waits. Returns
  /// how many messages that cost.
  std::size_t send(const SharedBytes& bytes);
  /// A message of its own: never dropped by newer state. Encodes it.
  void send(const Message& message);
  /// A keyframe that makes a subscriber current again: lets batches in once more.
  void resume_with(const Message& keyframe);
  /// Queues an end of what is said, then closes.
  void close(const std::optional<Message>& last, http::CloseReason reason);
  /// Since when it has been reading nothing although something waits.
  [[nodiscard]] std::optional<std::chrono::steady_clock::time_point> stalled_since() const;
  [[nodiscard]] std::chrono::steady_clock::time_point began() const { return began_; }

 private:
  [[nodiscard]] SharedBytes encode(const Message& message) const;
  void wake();
  void refuse(StreamErrorCode code, std::string where, std::string message);
  void handle(Message message);
  void handle_hello(const Hello& hello);
  void handle_frames(std::uint64_t media_time, const std::vector<TimedFrame>& frames);
  bool within_rate(std::size_t frames);

  const std::shared_ptr<Stream> stream_;
  const bool binary_;
  const bool subprotocol_offered_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  FrameDecoder decoder_;  ///< strand only
  double rate_tokens_;    ///< strand only
  std::chrono::steady_clock::time_point rate_time_ = began_;

  mutable std::mutex mutex_;  ///< guards what follows
  std::function<void()> wake_;
  std::deque<SharedBytes> pending_;
  bool subscribed_ = false;
  bool behind_ = false;  ///< batches were dropped; the next take() brings the newest state
  std::optional<std::chrono::steady_clock::time_point> stalled_since_;
  std::optional<StreamRole> role_;
  std::optional<http::CloseReason> closing_;
};

}  // namespace semblante::streams

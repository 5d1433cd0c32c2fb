#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/types/token_bucket.h"
#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/messages.h"
#include "server/http/websocket_peer.h"
#include "server/streams/stream_peer.h"

namespace semblante::streams {

/// One WebSocket of a stream: decodes and checks messages, calls the stream, and answers. Shared by the stream and
/// net's connection. There are thousands of them and most only subscribe, so members for publishers are allocated on
/// publishing.
class StreamConnection : public http::WebSocketPeer, public StreamPeer {
 public:
  /// Limit of the messages of one connection that are not a publisher's frames: most are answered.
  static constexpr double messages_per_second = 100, messages_burst = 1000;

  StreamConnection(std::shared_ptr<StreamAccess> stream, bool binary, bool subprotocol_offered,
                   ConnectionRights rights = {});
  ~StreamConnection() override;
  StreamConnection(const StreamConnection&) = delete;
  StreamConnection& operator=(const StreamConnection&) = delete;

  // ---- WebSocketPeer: net calls it on the connection's strand
  [[nodiscard]] std::string_view subprotocol() const override;
  [[nodiscard]] std::size_t max_message_bytes() const override;
  [[nodiscard]] http::OutboxLimits outbox_limits() const override;
  void attach(std::shared_ptr<http::WebSocketSink> sink) override;
  void receive(std::string_view bytes, bool binary) override;
  void writable() override;
  void disconnected() override;

  // ---- StreamPeer: any thread
  bool close(const Message& last, http::CloseReason reason) override;

 private:
  enum class Role : std::uint8_t { unknown, subscribes, publishes };

  // All on the strand: Sends an answer, which is never replaced by newer state.
  void send(const Message& message);
  void refuse(StreamErrorCode code, std::string where, std::string message);
  Result<Message> read(std::string_view bytes, bool binary);
  /// Counts a message that is answered; false, and closes, when there are too many.
  bool may_send_message();
  void handle(Message message);
  void handle_hello(const Hello& hello);
  void handle_spoken(const Spoken& spoken);
  void handle_captions(bool on);
  void handle_sound(SoundPacket sound);
  void handle_frames(std::uint64_t media_time, const std::vector<TimedFrame>& frames);

  const std::shared_ptr<StreamAccess> stream_;
  const bool binary_;
  const bool subprotocol_offered_;
  std::atomic<bool> closing_{false};
  Role role_ = Role::unknown;                                  ///< strand only
  bool has_sound_ = false;                                     ///< strand only; of a publisher: its hello says so
  TokenBucket messages_{messages_per_second, messages_burst};  ///< strand only
  std::unique_ptr<FrameDecoder> decoder_;  ///< strand only; of a publisher: its messages depend on earlier ones

  struct LastWords {
    http::SharedWire last;
    http::CloseReason reason;
  };
  std::mutex mutex_;  ///< guards setting the sink, and closing before it is set
  std::shared_ptr<http::WebSocketSink> sink_;
  std::unique_ptr<LastWords> last_words_;
};

}  // namespace semblante::streams

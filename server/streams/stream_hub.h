#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <variant>
#include <vector>

#include "server/http/websocket_peer.h"
#include "server/streams/batch_sender.h"
#include "server/streams/player.h"
#include "server/streams/stream.h"

namespace semblante::streams {

class BatchListener;

/// Reasons for refusing a connection.
enum class Refusal { no_such_stream, too_many };

/// The live streams of one node. A hub for a cluster would implement the same interface.
class StreamHub {
 public:
  virtual ~StreamHub() = default;
  /// Makes a stream; false when the id is taken.
  virtual bool open(const StreamInfo& info) = 0;
  /// Ends a stream and sends its connections the reason; false when there is no such stream.
  virtual bool close(std::string_view id, EndReason reason) = 0;
  /// Ends all streams because the server stops; later ones are not made.
  virtual void shut_down() = 0;
  [[nodiscard]] virtual std::vector<StreamInfo> list() const = 0;
  [[nodiscard]] virtual std::optional<StreamInfo> info(std::string_view id) const = 0;
  /// The header for a recording that begins now.
  [[nodiscard]] virtual std::optional<Header> header(std::string_view id) const = 0;
  [[nodiscard]] virtual StreamCounts counts() const = 0;
  /// Frames of a request. Errors: `missing` (no such stream), and those of Stream::publish_request.
  virtual Result<PublishReceipt> publish(std::string_view id, const std::vector<TimedFrame>& frames) = 0;
  /// Plays a source into a stream, beginning now. While it plays, other publishers and requests are refused. Plays are
  /// not stored: a restart of the server ends them. Errors: `missing` (no such stream); `mismatch` (another source
  /// holds the stream and options.take_over is not set); `too_large` (all playing sources would take too much memory).
  virtual Result<PlayStatus> play(std::string_view id, std::shared_ptr<const FrameSource> source,
                                  const PlayOptions& options) = 0;
  /// Ends a play; the face returns to neutral. False when that stream does not have it, or it has ended.
  virtual bool stop(std::string_view id, std::string_view play_id) = 0;
  /// Makes the peer of a WebSocket to a stream. `offered` is the client's Sec-WebSocket-Protocol, may be empty.
  virtual std::variant<std::shared_ptr<http::WebSocketPeer>, Refusal> connect(std::string_view id,
                                                                              std::string_view offered,
                                                                              ConnectionRights rights) = 0;
};

/// All streams of this process. It uses two threads: its own runs the players and closes slow connections, that of the
/// BatchSender sends. Any thread may call it.
class InProcessHub : public StreamHub {
 public:
  /// `group_sender` sends the batches; null: one call for each message.
  explicit InProcessHub(StreamLimits limits = {}, std::unique_ptr<http::GroupSender> group_sender = nullptr);
  ~InProcessHub() override;
  InProcessHub(const InProcessHub&) = delete;
  InProcessHub& operator=(const InProcessHub&) = delete;

  /// Sets the listener of all frames of present and future streams.
  void set_listener(std::shared_ptr<BatchListener> listener);

  bool open(const StreamInfo& info) override;
  bool close(std::string_view id, EndReason reason) override;
  void shut_down() override;
  [[nodiscard]] std::vector<StreamInfo> list() const override;
  [[nodiscard]] std::optional<StreamInfo> info(std::string_view id) const override;
  [[nodiscard]] std::optional<Header> header(std::string_view id) const override;
  [[nodiscard]] StreamCounts counts() const override;
  Result<PublishReceipt> publish(std::string_view id, const std::vector<TimedFrame>& frames) override;
  Result<PlayStatus> play(std::string_view id, std::shared_ptr<const FrameSource> source,
                          const PlayOptions& options) override;
  bool stop(std::string_view id, std::string_view play_id) override;
  std::variant<std::shared_ptr<http::WebSocketPeer>, Refusal> connect(std::string_view id, std::string_view offered,
                                                                      ConnectionRights rights) override;

 private:
  /// Its mutex is locked before a stream's, never after.
  struct Playing {
    explicit Playing(Player made) : player(std::move(made)) {}
    std::mutex mutex;
    Player player;
  };

  [[nodiscard]] std::shared_ptr<Stream> find(std::string_view id) const;
  [[nodiscard]] std::shared_ptr<Playing> find_playing(std::string_view id) const;
  [[nodiscard]] StreamInfo full_info(std::string_view id, const Stream& stream) const;
  void run();
  [[nodiscard]] std::vector<std::shared_ptr<Playing>> all_playing() const;
  /// With the mutex of none of them.
  void forget(const std::vector<std::shared_ptr<Playing>>& finished);

  const StreamLimits limits_;
  const std::shared_ptr<BatchSender> sender_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<BatchListener> listener_;
  bool stopping_ = false;
  bool shut_down_ = false;     ///< no more streams
  bool more_to_play_ = false;  ///< tells the thread that a player was added
  std::uint64_t last_epoch_ = 0;
  std::vector<std::string> order_;  ///< ids by creation
  std::map<std::string, std::shared_ptr<Stream>, std::less<>> streams_;
  std::map<std::string, std::shared_ptr<Playing>, std::less<>> playing_;   ///< by stream
  std::map<std::string, std::shared_ptr<Playing>, std::less<>> fillings_;  ///< by stream: its own filling
  std::map<std::string, PlayStatus, std::less<>> failed_;                  ///< by stream: its last play, if that failed
  std::uint64_t last_play_ = 0;
  StreamCounts gone_;  ///< sum of the counts of streams that have ended
  std::thread thread_;
};

}  // namespace semblante::streams

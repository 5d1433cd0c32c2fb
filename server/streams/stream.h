#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/messages.h"

namespace semblante::streams {

class BatchListener;
class StreamConnection;
using SharedBytes = std::shared_ptr<const std::string>;

struct StreamLimits {
  std::size_t max_connections = 256;  ///< of one stream
  std::size_t held_batches = 1024;    ///< for clients that come back
  std::chrono::milliseconds held_time{30'000};
  std::size_t pending_messages = 64;        ///< of one subscriber, before newest replaces all
  std::chrono::milliseconds stalled{5000};  ///< reading nothing for so long closes with 1013
  std::chrono::milliseconds hello_time{10'000};
  std::uint32_t frames_per_second = 500;  ///< of one publisher, on average
  std::uint32_t frames_burst = 2000;
  std::size_t playing_bytes = std::size_t{512} << 20U;  ///< of all that plays, in all streams together
};

/// What is being played into a stream. Times in ms.
struct PlayStatus {
  std::string id, kind, name;
  double duration = 0.0;  ///< 0: without end
  double position = 0.0;
  double rate = 0.0;  ///< frames a second
  bool loop = false;
};

/// What a stream says about itself.
struct StreamInfo {
  std::string id, title, model, created;
  std::string source;  ///< "demo" or "none": what feeds it when nobody publishes
  std::uint64_t epoch = 0, sequence = 0;
  std::size_t subscribers = 0, publishers = 0;
  std::optional<double> viseme_share;  ///< of Eq. 5, 0..1; without it clients take that of their model
  std::optional<PlayStatus> playing;   ///< filled in by the hub
  std::uint64_t clamped_values = 0;    ///< that were beyond the range of their FAP
  std::uint32_t batch_interval = 0;    ///< ms for which frames are gathered into one message; 0: each is sent at once
};

struct StreamCounts {
  std::uint64_t frames = 0, messages_sent = 0, messages_replaced = 0, closed_slow = 0, refused = 0, clamped_values = 0;
};

/// Who feeds a stream. One connection publishes or one source plays at a time; a REST call comes between only while
/// neither does.
enum class Source { connection, request };

struct PublishReceipt {
  std::size_t accepted = 0;
  std::uint64_t sequence = 0;  ///< of the last frame
  std::size_t clamped = 0;     ///< values that were beyond the range of their FAP
};

/// One live stream: the newest state, a short memory, and who listens. Shared by the hub and its connections; one
/// mutex, taken before the mutex of a connection, never after. Each batch is encoded once per subprotocol, and all
/// subscribers get the same bytes.
class Stream : public std::enable_shared_from_this<Stream> {
 public:
  using Clock = std::chrono::steady_clock;

  Stream(StreamInfo info, StreamLimits limits);

  [[nodiscard]] const StreamLimits& limits() const { return limits_; }
  [[nodiscard]] StreamInfo info() const;
  [[nodiscard]] StreamCounts counts() const;

  /// Who hears every batch from now on; null: nobody. One at a time.
  void set_listener(std::shared_ptr<BatchListener> listener);

  /// Takes frames in and sends them on. Errors: conflict (somebody else publishes) as `mismatch`; empty list as
  /// `empty`.
  Result<PublishReceipt> publish(Source source, std::uint64_t media_time, const std::vector<TimedFrame>& frames);

  /// Makes what plays (frames a second: rate) the stream's only source. The ticket for publish_playing. Errors:
  /// conflict (a connection publishes, or something else plays) as `mismatch`, unless it takes over: then that
  /// connection is told `replaced` and closed.
  Result<std::uint64_t> begin_playing(double rate, bool take_over);
  /// One frame of what plays, at its own time. Errors: `mismatch` when it plays no more.
  Status publish_playing(std::uint64_t ticket, Clock::time_point when, const TimedFrame& frame);
  /// Nothing when somebody else plays by now. `neutral`: the face goes back to rest.
  void end_playing(std::uint64_t ticket, bool neutral);
  /// A frame of the stream's own source, which gives way to all others and comes back when they are silent.
  Status fill(Clock::time_point when, const TimedFrame& frame);

  /// A new connection, before its hello. False when the stream has as many as it takes, or has ended.
  bool admit(const std::shared_ptr<StreamConnection>& connection);
  void leave(StreamConnection& connection);
  /// After the hello: queues header and keyframe (or the gap) into the connection and lets frames follow.
  void subscribe(StreamConnection& connection, const Hello& hello);
  /// After the hello: false when another connection publishes.
  bool begin_publishing(StreamConnection& connection);
  /// The newest state for a subscriber that fell behind; from here on batches reach it again.
  void catch_up(StreamConnection& connection);

  /// Ends it for everyone. Connections are told the reason and closed.
  void end(EndReason reason);
  /// Closes connections that say no hello, or read nothing. A few times a second.
  void look_after_connections();

  [[nodiscard]] std::uint64_t media_time_now() const;
  static double server_time_now();

 private:
  struct Batch {
    Frames message;
    FaceFrame state_before;
    SharedBytes binary, json;  ///< json is encoded when somebody wants it
    std::chrono::steady_clock::time_point when;
  };

  /// What every source goes through: values beyond the range of their FAP are clamped, and counted.
  PublishReceipt take(std::uint64_t media_time, const std::vector<TimedFrame>& frames);
  [[nodiscard]] std::uint64_t media_time_at(Clock::time_point when) const;
  /// A played frame keeps its own time, but never falls behind the frame before it by a breath.
  [[nodiscard]] std::uint64_t place_played(Clock::time_point when) const;
  Header make_header(bool recovered) const;
  const SharedBytes& encoded(Batch& batch, bool binary) const;
  void send_keyframe(StreamConnection& connection, std::uint64_t sequence, std::uint64_t media_time,
                     const FaceFrame& state) const;
  std::uint64_t place_in_time(Source source, std::uint64_t media_time);

  const StreamLimits limits_;
  mutable std::mutex mutex_;
  StreamInfo info_;
  StreamCounts counts_;
  FaceFrame state_;
  std::uint64_t media_time_ = 0;  ///< of the newest frame
  FrameEncoder encoder_;
  std::deque<Batch> held_;
  std::vector<std::shared_ptr<StreamConnection>> connections_;
  std::shared_ptr<BatchListener> listener_;
  StreamConnection* publisher_ = nullptr;
  std::uint64_t player_ = 0;  ///< ticket of what plays; 0: nothing
  std::uint64_t last_ticket_ = 0;
  double rate_ = 0.0;  ///< frames a second of what plays
  bool ended_ = false;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_live_;  ///< when somebody other than its own source did
  std::int64_t publisher_offset_ = 0;                ///< stream clock minus the publisher's
  bool publisher_offset_known_ = false;
};

}  // namespace semblante::streams

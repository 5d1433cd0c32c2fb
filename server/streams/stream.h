#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/packed_codec.h"
#include "protocol/cpp/quantizers.h"
#include "server/streams/flood_guard.h"
#include "server/streams/source.h"
#include "server/streams/stream_counts.h"
#include "server/streams/subscriber_list.h"
#include "server/streams/timeline.h"

namespace semblante::streams {

class BatchListener;
class BatchSender;
class StreamConnection;

struct StreamLimits {
  std::size_t max_connections = 16384;  ///< of one stream
  std::size_t held_batches = 1024;      ///< for clients that come back
  std::chrono::milliseconds held_time{30'000};
  std::size_t resumed_frames = 1024;       ///< sent again at most to one who comes back
  std::size_t resumed_bytes = 256 * 1024;  ///< in one go
  std::size_t pending_messages = 16;       ///< of one subscriber, before newest replaces all
  std::size_t pending_bytes = 256 * 1024;
  std::chrono::milliseconds stalled{5000};  ///< reading nothing for so long closes with 1013
  std::chrono::milliseconds hello_time{10'000};
  std::chrono::milliseconds demo_patience{3000};  ///< without live frames: then the stream's own filling comes back
  FloodLimits publisher;  ///< of one connection that publishes, and of all requests of one stream together
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
  double quantizer_scale = 1.0;        ///< of its steps against the standard ones: one of quantizer_scales
  std::optional<Source> active_source{};  ///< who feeds it now; of requests: within the last seconds
  std::array<std::size_t, coding_count> subscribers_by_coding{};
  StreamCounts counts{};
};

struct PublishReceipt {
  std::size_t accepted = 0;
  std::uint64_t sequence = 0;  ///< of the last frame
  std::size_t clamped = 0;     ///< values that were beyond the range of their FAP
};

/// One live stream: the newest state, a short memory, and who listens. Shared by the hub and its connections. Frames
/// are gathered into batches; each is encoded once per form, and all subscribers get the same bytes. Those are sent
/// outside the mutex, in slices: a publisher or a newcomer waits for nobody's socket.
class Stream : public std::enable_shared_from_this<Stream> {
 public:
  using Clock = std::chrono::steady_clock;

  /// `sender` calls work(); without one, whoever brings frames sends them himself.
  Stream(StreamInfo info, StreamLimits limits, std::shared_ptr<BatchSender> sender = nullptr);

  [[nodiscard]] const StreamLimits& limits() const { return limits_; }
  /// What its levels are: FAP units a level.
  [[nodiscard]] const QuantizerSteps& steps() const { return steps_; }
  [[nodiscard]] StreamInfo info() const;
  [[nodiscard]] StreamCounts counts() const;

  /// Who hears every batch from now on; null: nobody. One at a time.
  void set_listener(std::shared_ptr<BatchListener> listener);

  /// Frames from a request, or from the connection `from` that publishes. `media_time`: by the publisher's clock; 0:
  /// now. Errors: `mismatch` (somebody else publishes or plays), `empty` (no frame), `out_of_range` (they last too
  /// long), `too_large` (too many in too short a time, or too far ahead of the clock already: later there is room).
  Result<PublishReceipt> publish(Source source, std::uint64_t media_time, const std::vector<TimedFrame>& frames,
                                 const StreamConnection* from = nullptr);

  /// Makes what plays (frames a second: rate) the stream's only source. The ticket for publish_playing. Errors:
  /// conflict (a connection publishes, or something else plays) as `mismatch`, unless it takes over: then that
  /// connection is told `replaced` and closed.
  Result<std::uint64_t> begin_playing(double rate, bool take_over, Source source = Source::performance);
  /// One frame of what plays, at its own time. Errors: `mismatch` when it plays no more.
  Status publish_playing(std::uint64_t ticket, Clock::time_point when, const TimedFrame& frame);
  /// Nothing when somebody else plays by now. `neutral`: the face goes back to rest.
  void end_playing(std::uint64_t ticket, bool neutral);
  /// A frame of the stream's own source, which gives way to all others and comes back when they are silent.
  Status fill(Clock::time_point when, const TimedFrame& frame);

  /// A new connection, before its hello. False when the stream has as many as it takes, or has ended.
  bool admit(const std::shared_ptr<StreamConnection>& connection);
  void leave(StreamConnection& connection);
  /// After the hello: sends header and keyframe (or the gap) and lets the batches follow that are made from then on.
  void subscribe(StreamConnection& connection, const Hello& hello);
  /// After the hello: false when another source is there, unless it takes over; then that one is told `replaced` and
  /// closed, or plays no more.
  bool begin_publishing(StreamConnection& connection, bool take_over);
  /// A publisher says that it has finished: the next one need not wait until its socket is closed.
  void end_publishing(const StreamConnection& connection);
  /// A publisher is about to be closed because it floods.
  void dismiss(StreamConnection& connection);
  /// All that waited for it has gone. If it fell behind it gets the newest state; from there on batches reach it again.
  void writable(StreamConnection& connection);
  void count_throttled(std::size_t frames);
  void count_dropped() { ++dropped_; }

  /// Ends it for everyone. Connections are told the reason and closed.
  void end(EndReason reason);
  /// Closes connections that say no hello, or read nothing. A few times a second.
  void look_after_connections();

  /// Closes the batch that is due at `now` and sends to some of the subscribers; returns when it wants to be called
  /// again: at once (not after `now`), later, or never (time_point::max()).
  Clock::time_point advance(Clock::time_point now);
  /// advance(), for the sender: nothing if the stream has asked for another time since it asked for `asked`.
  Clock::time_point work(Clock::time_point asked);

  [[nodiscard]] std::uint64_t media_time_now() const;
  /// When the newest frame is to be seen: what has times of its own begins no earlier, for no frame is before another.
  [[nodiscard]] Clock::time_point newest_frame_time() const;
  static double server_time_now();

 private:
  struct Batch {
    std::uint64_t number = 0;
    Frames message;
    PackedEncoder before;                              ///< as it was, with the state
    std::array<http::SharedWire, coding_count> wires;  ///< packed at once, others when somebody wants them
    Clock::time_point when, due;
  };
  /// Without a sender: sends when the mutex has been left.
  class SendAfter;
  struct Target {
    http::WebSocketSink* sink;
    StreamConnection* connection;
    Coding coding;
    http::Sent sent;
  };

  /// What every source goes through: values beyond the range of their FAP are clamped, and counted.
  PublishReceipt take(Source source, std::uint64_t media_time, std::vector<TimedFrame> frames);
  /// Tells the connection that publishes, if there is one, that another source has taken over.
  void replace_publisher();
  [[nodiscard]] std::optional<Source> active_source() const;
  [[nodiscard]] std::uint64_t media_time_at(Clock::time_point when) const;
  Header make_header(bool recovered, StreamCoding coding) const;
  // With the mutex held, all of them.
  void gather(std::uint64_t media_time, const std::vector<TimedFrame>& frames);
  void close_batch(Clock::time_point due);
  [[nodiscard]] bool may_close_batch() const;
  void want(Clock::time_point when);
  [[nodiscard]] Clock::time_point next_work(Clock::time_point now) const;
  const http::SharedWire& wire_of(Batch& batch, Coding coding);
  template <class Write>
  void keep_wire(Batch& batch, Coding coding, const Write& write);
  const http::SharedWire& join_point(Coding coding);
  [[nodiscard]] std::size_t find_held(const ResumePoint& resume) const;
  [[nodiscard]] http::SharedWire gap_from(std::size_t held, Coding coding);
  void rejoin(Subscriber& subscriber);
  void settle(std::span<const Target> targets, const std::array<http::SharedWire, coding_count>& wires);
  void tell_end(StreamConnection& connection, EndReason reason);
  /// Without it.
  std::size_t send_slice(std::span<Target> targets, const std::array<http::SharedWire, coding_count>& wires,
                         Clock::time_point due);

  const StreamLimits limits_;
  const QuantizerSteps steps_;
  const std::shared_ptr<BatchSender> sender_;
  const std::shared_ptr<metrics::LatenessHistogram> lateness_;
  std::atomic<std::uint64_t> dropped_{0};
  std::mutex pass_mutex_;        ///< of who sends a slice; taken before mutex_
  std::vector<Target> targets_;  ///< of that slice
  mutable std::mutex mutex_;     ///< guards what follows
  StreamInfo info_;              ///< sequence: of the newest frame taken
  StreamCounts counts_;
  PackedEncoder packed_;  ///< with sequence, media time and state as of the last batch
  Timeline timeline_;
  Frames gathering_;  ///< not yet in a batch; no frames: nothing
  Clock::time_point gather_due_;
  Clock::time_point wanted_ = Clock::time_point::max();  ///< when the sender is to call
  std::uint64_t batches_ = 0;
  std::deque<std::shared_ptr<Batch>> held_;
  std::deque<std::shared_ptr<Batch>> passes_;  ///< not yet sent to all; the first is being sent
  std::array<http::SharedWire, coding_count> join_points_;
  SubscriberList subscribers_;
  bool in_slice_ = false;                                  ///< subscribers' connections must stay
  std::vector<std::shared_ptr<StreamConnection>> parked_;  ///< that left meanwhile
  std::vector<std::shared_ptr<StreamConnection>> connections_;
  std::deque<std::weak_ptr<StreamConnection>> newcomers_;  ///< oldest first
  std::shared_ptr<BatchListener> listener_;
  StreamConnection* publisher_ = nullptr;
  std::uint64_t player_ = 0;  ///< ticket of what plays; 0: nothing
  std::uint64_t last_ticket_ = 0;
  double rate_ = 0.0;  ///< frames a second of what plays
  bool ended_ = false;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_live_;  ///< when somebody other than its own source did
  Source playing_ = Source::performance;             ///< what plays, if something does
  bool last_was_request_ = false;                    ///< what was live then
  FloodGuard requests_;
};

}  // namespace semblante::streams

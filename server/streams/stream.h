#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/quantizers.h"
#include "server/streams/batch_log.h"
#include "server/streams/client_list.h"
#include "server/streams/fan_out.h"
#include "server/streams/source_arbiter.h"
#include "server/streams/stream_info.h"
#include "server/streams/stream_limits.h"
#include "server/streams/stream_peer.h"

namespace semblante::streams {

class BatchListener;
class BatchSender;

/// One live stream, shared by the hub and its connections. It owns the mutexes and connects the parts: SourceArbiter
/// decides which frames are accepted, BatchLog makes batches of them, FanOut sends the batches to the subscribers, and
/// ClientList owns the connections. Batches are sent without the mutex, in slices, so that publishers and new
/// connections never wait for a socket. Any thread.
class Stream : public StreamAccess, public std::enable_shared_from_this<Stream> {
 public:
  using Clock = std::chrono::steady_clock;
  using Ticket = SourceArbiter::Ticket;

  /// `sender` calls work(). Without one, the thread that publishes frames also sends them.
  Stream(StreamInfo info, StreamLimits limits, std::shared_ptr<BatchSender> sender = nullptr);

  [[nodiscard]] StreamInfo info() const;
  [[nodiscard]] StreamCounts counts() const;
  /// The header for recordings and, with members of the connection added, for clients.
  [[nodiscard]] Header header() const;

  /// Sets the listener of all frames from now on; null: none. One at a time.
  void set_listener(std::shared_ptr<BatchListener> listener);

  // ---- sources

  /// Frames of a request. Errors: `mismatch` (another source holds the stream), `empty` (no frame), `out_of_range`
  /// (they last too long), `too_large` (too many per second, or too far ahead of the clock: retry later), `missing`
  /// (the stream has ended).
  Result<PublishReceipt> publish_request(const std::vector<TimedFrame>& frames);
  /// Makes a player, with `rate` frames per second, the holder of the stream. Errors: `mismatch` when another source
  /// holds it and `take_over` is not set, `missing`. A publisher that loses the stream gets `replaced` and is closed.
  Result<Ticket> begin_playing(double rate, bool take_over, Source source = Source::performance);
  /// One frame of a player, due at `when`. Errors: `mismatch` when the play has ended.
  Status publish_playing(Ticket ticket, Clock::time_point when, const TimedFrame& frame);
  /// One packet of a player's sound, due at `when`. Dropped when the play has ended.
  void play_sound(Ticket ticket, Clock::time_point when, const std::vector<std::uint8_t>& packet);
  /// A sentence of this play, whose first word begins at `when`, for captions. `replaces`: also for clients with a
  /// voice of their own, which get neither frames nor sound of the play until it ends. An empty one: what is being said
  /// stops.
  void publish_text(Ticket ticket, Clock::time_point when, SpeechText text, bool replaces = true);
  /// Does nothing when another source holds the stream already. `neutral`: the face returns to neutral.
  void end_playing(Ticket ticket, bool neutral);
  /// A frame of the stream's own filling; dropped while another source feeds the stream or did so recently.
  Status fill(Clock::time_point when, const TimedFrame& frame);
  /// When the newest frame is to be shown. A source with its own times begins no earlier, because media time never
  /// decreases.
  [[nodiscard]] Clock::time_point newest_frame_time() const;

  // ---- connections

  /// Adds a new connection, before its hello. False when the limit of connections is reached or the stream has ended.
  bool admit(const std::shared_ptr<StreamPeer>& client);

  [[nodiscard]] const QuantizerSteps& steps() const override { return steps_; }
  [[nodiscard]] http::OutboxLimits outbox_limits() const override;
  [[nodiscard]] std::uint64_t media_time_now() const override { return media_time_at(began_, Clock::now()); }
  void subscribe(StreamPeer& client, http::WebSocketSink& sink, const Hello& hello, bool binary) override;
  Result<Header> begin_publishing(StreamPeer& client, const Hello& hello) override;
  std::optional<SourceArbiter::Refusal> publish(StreamPeer& client, std::uint64_t media_time,
                                                const std::vector<TimedFrame>& frames) override;
  Status publish_sound(StreamPeer& client, SoundPacket sound) override;
  void end_publishing(StreamPeer& client) override;
  void writable(StreamPeer& client) override;
  void leave(StreamPeer& client) override;
  Status spoken(StreamPeer& client, const Spoken& spoken) override;
  void show_captions(StreamPeer& client, bool on) override;
  void answer_dropped() override { ++answers_dropped_; }

  // ---- threads of the hub

  /// Sends all connections the reason and closes them. Accepted frames are sent first.
  void end(EndReason reason);
  /// Closes connections that send no hello, or read nothing. To be called a few times per second.
  void look_after_connections();
  /// Closes the batch that is due at `now`, and sends one slice. Returns when it is to be called again: immediately
  /// (not after `now`), later, or never (time_point::max()).
  Clock::time_point advance(Clock::time_point now);
  /// advance() for the sender. Does nothing if the stream has scheduled another time than `asked` meanwhile. After an
  /// exception the stream still waits for a call with `asked`.
  Clock::time_point work(Clock::time_point asked);

 private:
  class SendAfter;

  // All with mutex_ held:
  PublishReceipt take(Source source, std::uint64_t media_time, std::vector<TimedFrame> frames, Clock::time_point now);
  void take_sound(SoundPacket sound, Clock::time_point due, Clock::time_point now);
  Result<Ticket> claim(Source source, double rate, bool take_over, StreamPeer* publisher);
  void release(StreamPeer& publisher);
  /// The speech whose text was sent is over.
  void end_text();
  /// What is being said stops.
  void hush(Clock::time_point when, Clock::time_point now);
  [[nodiscard]] StreamCounts all_counts() const;
  [[nodiscard]] Header header_for(bool recovered, bool sound = false) const;
  [[nodiscard]] Clock::time_point next_work(Clock::time_point now) const;
  void want(Clock::time_point when);

  // Never changed.
  const StreamInfo made_;  ///< id, created, source, settings, epoch; other members are empty
  const StreamLimits limits_;
  const QuantizerSteps steps_;
  const Clock::time_point began_ = Clock::now();
  const std::shared_ptr<BatchSender> sender_;
  const std::shared_ptr<metrics::LatenessHistogram> lateness_;

  std::atomic<std::uint64_t> answers_dropped_{0};
  std::mutex pass_mutex_;  ///< held by the thread that sends a slice; taken before mutex_
  Slice slice_;            ///< guarded by pass_mutex_

  mutable std::mutex mutex_;  ///< guards the members below
  StreamCounts counts_;       ///< without the counts of the parts: see all_counts()
  SourceArbiter sources_;
  BatchLog log_;
  FanOut fan_out_{counts_};
  std::uint64_t speeches_ = 0;  ///< number of the newest text
  ClientList clients_;
  StreamPeer* publisher_ = nullptr;  ///< the connection that holds the stream, or null
  std::shared_ptr<BatchListener> listener_;
  Clock::time_point wanted_ = Clock::time_point::max();  ///< when the sender is to call work()
  bool ended_ = false;
};

}  // namespace semblante::streams

#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "server/http/websocket_peer.h"
#include "server/metrics/histogram.h"
#include "server/streams/batch_log.h"
#include "server/streams/stream_counts.h"
#include "server/streams/subscriber_list.h"

namespace semblante::streams {

/// Up to 256 subscribers and what each is sent next. Chosen with the stream's mutex held, sent without it, and reported
/// back with it.
class Slice {
 public:
  /// Hands each target its message. Touches nothing but the slice, the sockets' outboxes, and the histogram.
  void send(metrics::LatenessHistogram& lateness);

 private:
  friend class FanOut;
  struct Target {
    http::WebSocketSink* sink;
    StreamPeer* client;
    Coding coding;
    http::Sent sent;
  };
  std::vector<Target> targets_;
  std::array<http::SharedWire, coding_count> wires_;
  std::chrono::steady_clock::time_point due_;
  std::size_t replaced_ = 0;  ///< messages that waited for targets which take no more
};

/// Brings batches to the subscribers of a stream, one slice after another. A subscriber that reads too slowly *falls
/// behind*: what waits for it is dropped, and it gets no batch until it can be written to again; then it gets the
/// newest state. Not synchronized, but see Slice.
class FanOut {
 public:
  using Clock = std::chrono::steady_clock;

  /// Counts messages into `counts`, which outlives it and is guarded by the same mutex.
  explicit FanOut(StreamCounts& counts) : counts_(counts) {}

  [[nodiscard]] std::size_t size() const { return subscribers_.size(); }
  [[nodiscard]] std::array<std::size_t, coding_count> by_coding() const;

  /// A subscriber whose `begin` has been sent; the log's next batch is its first. `waits`: not all of it has gone yet.
  void add(StreamPeer& client, http::WebSocketSink& sink, Coding coding, const http::WireMessage& begin, bool waits,
           const BatchLog& log);
  void remove(StreamPeer& client);
  void remove_all();

  /// Takes a closed batch on its way to all subscribers there are now.
  void push(std::shared_ptr<Batch> batch);
  [[nodiscard]] bool is_idle() const { return passes_.empty(); }
  /// False while so many batches are on their way that frames should gather longer instead.
  [[nodiscard]] bool has_room() const { return passes_.size() < most_passes; }

  /// Chooses the next slice; false when nothing is on its way.
  bool next_slice(Slice& slice, BatchLog& log);
  /// Takes note of what became of a slice that has been sent.
  void finish_slice(Slice& slice, BatchLog& log);
  /// Sends all that is on its way, at once: the stream ends.
  void send_rest(BatchLog& log);

  /// All that waited for a subscriber has gone: one that fell behind gets the newest state.
  void writable(StreamPeer& client, BatchLog& log);
  /// Removes, and returns, subscribers that have read nothing for longer than `patience` although something waits.
  std::vector<StreamPeer*> remove_stalled(std::chrono::milliseconds patience, Clock::time_point now);

 private:
  /// When sending takes longer than frames do to come, they gather into longer batches instead of a longer queue.
  static constexpr std::size_t most_passes = 4;

  void count_sent(const http::WireMessage& message);
  void send_newest(Subscriber& subscriber, BatchLog& log);

  StreamCounts& counts_;
  SubscriberList subscribers_;
  std::deque<std::shared_ptr<Batch>> passes_;  ///< on their way; the first is being sent
};

}  // namespace semblante::streams

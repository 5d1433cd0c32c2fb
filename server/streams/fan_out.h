#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "server/http/group_sender.h"
#include "server/metrics/histogram.h"
#include "server/streams/batch_log.h"
#include "server/streams/stream_counts.h"
#include "server/streams/subscriber_list.h"

namespace semblante::streams {

/// Up to 256 subscribers and the next message for each. Filled with the stream's mutex held, sent without it, and its
/// results are processed with it.
class Slice {
 public:
  /// Sends each target its message. Uses only the slice, the sockets' outboxes, the sender and the histogram.
  void send(http::GroupSender& sender, metrics::LatenessHistogram& lateness);

 private:
  friend class FanOut;
  struct Target {
    StreamPeer* client;
    Coding coding;
  };
  std::vector<Target> targets_;
  std::vector<http::Delivery> deliveries_;  ///< of each target, in their order
  std::array<http::SharedWire, coding_count> wires_;
  std::chrono::steady_clock::time_point due_;
  enum class Content : std::uint8_t { batch, sound, text } content_ = Content::batch;
  std::size_t replaced_ = 0;  ///< pending messages dropped for targets that fell behind
};

/// Sends batches to the subscribers of a stream, one slice after another. A subscriber that reads too slowly *falls
/// behind*: its pending messages are dropped, and it gets no batch until its socket is writable again; then it gets the
/// newest state. Sound goes only to subscribers for whom nothing waits, so that it never takes the place of frames.
/// *Readers* get the sentences of speech in place of its frames and sound; who shows captions gets them beside. Not
/// synchronized, but see Slice.
class FanOut {
 public:
  using Clock = std::chrono::steady_clock;

  /// Counts messages in `counts`, which must outlive this object and is guarded by the same mutex.
  explicit FanOut(StreamCounts& counts) : counts_(counts) {}

  [[nodiscard]] std::size_t size() const { return subscribers_.size(); }
  [[nodiscard]] std::array<std::size_t, coding_count> by_coding() const;

  /// What a subscriber has asked for.
  struct Wishes {
    bool sound = false;
    bool text = false;
    bool captions = false;
  };
  /// Adds a subscriber whose `begin` has been sent; the log's next batch is its first. `waits`: part of `begin` is
  /// still in the outbox.
  void add(StreamPeer& client, http::WebSocketSink& sink, Coding coding, Wishes wishes, const http::WireMessage& begin,
           bool waits, const BatchLog& log);
  void remove(StreamPeer& client);
  void remove_all();

  /// Queues a closed batch for all current subscribers.
  void push(std::shared_ptr<Batch> batch);
  /// Queues a packet of sound for all current listeners; drops it when sending is slow.
  void push_sound(SoundPacket sound, Clock::time_point due);
  /// Queues a sentence for all who get text and keeps it until `until` for those who come meanwhile. `replaces`: from
  /// now on readers get neither frames nor sound, until end_text(); else it is for captions alone.
  void push_text(SpeechText text, Clock::time_point due, Clock::time_point until, bool replaces);
  /// What is being said stops: its readers and captions are told to `hush`.
  void hush(SpeechText hush, Clock::time_point now);
  /// The speech is over: readers get the newest state.
  void end_text(Clock::time_point now);
  [[nodiscard]] bool is_text() const { return is_text_; }
  /// A sentence is still being said at `now`, as far as was estimated.
  [[nodiscard]] bool says(Clock::time_point now) const;
  /// A subscriber becomes a reader, or one that is none gets frames again.
  void set_reads(StreamPeer& client, bool reads, BatchLog& log);
  [[nodiscard]] bool reads(StreamPeer& client) const;
  /// A subscriber gets text beside its frames from now on, or no more.
  void set_captions(StreamPeer& client, bool captions);
  [[nodiscard]] bool is_idle() const { return passes_.empty(); }
  /// False while the queue of batches is full; frames should gather longer then.
  [[nodiscard]] bool has_room() const { return passes_.size() - sounds_ < most_passes; }

  /// Fills the next slice; false when no batch is queued.
  bool next_slice(Slice& slice, BatchLog& log);
  /// Processes the results of a slice that has been sent.
  void finish_slice(Slice& slice, BatchLog& log);
  /// Sends all queued batches immediately, at the end of the stream; the newest state to those that are behind.
  void send_rest(BatchLog& log);

  /// A subscriber's outbox is empty again: if it fell behind, it gets the newest state.
  void writable(StreamPeer& client, BatchLog& log);
  /// Removes and returns subscribers that have read nothing for longer than `patience` although messages are pending.
  std::vector<StreamPeer*> remove_stalled(std::chrono::milliseconds patience, Clock::time_point now);

 private:
  /// When sending is slower than frames arrive, they gather into longer batches instead of a longer queue.
  static constexpr std::size_t most_passes = 4;
  /// Packets of sound that wait besides: what a machine with much else to do is behind for a moment, a second of
  /// packets of 60 ms.
  static constexpr std::size_t most_sounds = 16;

  enum class Kind : std::uint8_t { batch, sound, text, newest };
  /// What is sent to all subscribers. `newest`: the newest state, to readers who have missed frames.
  struct Pass {
    Kind kind = Kind::batch;
    std::shared_ptr<Batch> batch;  ///< null unless it is one
    Message message;               ///< sound or text
    std::array<http::SharedWire, coding_count> wires;
    Clock::time_point due;
    bool of_text = false;  ///< of a speech whose text readers get: its frames, its sound or that text
  };
  static const http::SharedWire& message_wire(Pass& pass, Coding coding);
  /// A sentence that is being said.
  struct Said {
    SpeechText text;
    Clock::time_point until;
    bool for_readers = false;                          ///< else for captions alone
    std::array<http::SharedWire, coding_count> wires;  ///< once somebody came too late for its pass
    [[nodiscard]] bool is_for(const Subscriber& subscriber) const {
      return subscriber.captions || (for_readers && subscriber.reads);
    }
  };
  /// False: the subscriber cannot take more now.
  bool send_text(Subscriber& subscriber, Said& said);
  void send_texts(Subscriber& subscriber, Clock::time_point now);

  void count_sent(const http::WireMessage& message);
  void drop(std::size_t slot);
  /// Sets what `subscriber` is to get of the first pass; null: nothing.
  const http::SharedWire* next_wire(Slice& slice, Subscriber& subscriber, BatchLog& log);
  void send_newest(Subscriber& subscriber, BatchLog& log);

  StreamCounts& counts_;
  SubscriberList subscribers_;
  std::size_t sounds_ = 0;     ///< of the passes, those of sound
  std::size_t listeners_ = 0;  ///< subscribers that get the sound
  std::size_t readers_ = 0;
  std::size_t captioned_ = 0;  ///< subscribers that get text beside frames
  bool is_text_ = false;       ///< what enters the stream is a speech whose text readers get
  std::vector<Said> said_;     ///< at most a few: whoever adds one drops those that have ended
  std::optional<Said> hush_;   ///< the last one: who has fallen behind still gets it
  std::deque<Pass> passes_;    ///< queue; the first is being sent
};

}  // namespace semblante::streams

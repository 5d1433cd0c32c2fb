#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "server/http/websocket_peer.h"
#include "server/streams/encoding.h"

namespace semblante::streams {

class StreamPeer;

/// One subscriber of the fan-out.
struct Subscriber {
  static constexpr std::size_t nowhere = SIZE_MAX;

  StreamPeer* client = nullptr;
  http::WebSocketSink* sink = nullptr;
  std::size_t* slot = nullptr;   ///< where its current index in the list is stored
  std::uint64_t next_batch = 0;  ///< number of the first batch it has not been sent
  std::uint64_t told = 0;        ///< number of the newest text it has been sent, or need not be
  Coding coding = Coding::packed;
  bool listens = false;   ///< asked for the sound
  bool reads = false;     ///< has a voice of its own: gets text in place of the frames and the sound of speech
  bool captions = false;  ///< gets text beside them
  bool away = false;      ///< has missed frames for the sake of text: needs the newest state before the next batch
  bool behind = false;    ///< needs the newest state before the next batch
  bool waits = false;     ///< its outbox may have messages
};

/// The subscribers of a stream, contiguous in memory, and the cursor of the pass that sends a batch to them.
/// Subscribers may be added and removed during a pass: each one present from its beginning to its end is visited once.
/// Not synchronized.
class SubscriberList {
 public:
  [[nodiscard]] std::size_t size() const { return items_.size(); }
  [[nodiscard]] Subscriber& operator[](std::size_t slot) { return items_[slot]; }
  [[nodiscard]] std::span<Subscriber> all() { return items_; }
  [[nodiscard]] std::span<const Subscriber> all() const { return items_; }

  void add(const Subscriber& subscriber) {
    *subscriber.slot = items_.size();
    items_.push_back(subscriber);
  }

  void remove(std::size_t slot) {
    assert(slot < items_.size());
    *items_[slot].slot = Subscriber::nowhere;
    // Keeps visited subscribers before the cursor and the others after it.
    if (slot < cursor_) {
      --cursor_;
      if (slot != cursor_) place(items_[cursor_], slot);
      slot = cursor_;
    }
    if (slot + 1 != items_.size()) place(items_.back(), slot);
    items_.pop_back();
  }

  void begin_pass() { cursor_ = 0; }
  [[nodiscard]] bool pass_done() const { return cursor_ >= items_.size(); }
  /// The next subscribers of this pass, at most `most`. Valid until add() or remove().
  std::span<Subscriber> next(std::size_t most) {
    const auto count = std::min(most, items_.size() - cursor_);
    const auto part = std::span(items_).subspan(cursor_, count);
    cursor_ += count;
    return part;
  }

 private:
  void place(const Subscriber& subscriber, std::size_t slot) {
    *subscriber.slot = slot;
    items_[slot] = subscriber;
  }

  std::vector<Subscriber> items_;
  std::size_t cursor_ = 0;
};

}  // namespace semblante::streams

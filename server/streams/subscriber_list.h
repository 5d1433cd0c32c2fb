#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "server/http/websocket_peer.h"

namespace semblante::streams {

class StreamConnection;

/// The forms in which a stream's batches are sent. Each is made once, when somebody wants it.
enum class Coding : std::uint8_t { packed, plain, json };
inline constexpr std::size_t coding_count = 3;
inline constexpr std::array<std::string_view, coding_count> coding_names = {"packed", "plain", "json"};

/// One who listens, as the thread that sends sees it.
struct Subscriber {
  static constexpr std::size_t nowhere = SIZE_MAX;

  StreamConnection* connection = nullptr;
  http::WebSocketSink* sink = nullptr;
  std::size_t* slot = nullptr;   ///< where it is told its place in the list
  std::uint64_t next_batch = 0;  ///< the first it has not been sent
  Coding coding = Coding::plain;
  bool behind = false;  ///< gets no batch before it gets a new join point
  bool waits = false;   ///< something may wait in its outbox
};

/// Who listens to a stream, side by side in memory, and how far the pass over them has come that sends a batch. They
/// come and go while it is under way: everyone who was there when it began and still is gets visited, once. Not
/// synchronized.
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
    // Those before the cursor stay before it, those behind stay behind.
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
  /// The next few of this pass. Valid until somebody comes or goes.
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

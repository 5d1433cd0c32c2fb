#include "server/streams/fan_out.h"

#include <utility>

#include "server/streams/stream_peer.h"

namespace semblante::streams {
namespace {

using Clock = FanOut::Clock;

/// Subscribers per slice, after which another stream has its turn.
constexpr std::size_t slice_size = 256;
/// The clock is read once per this number of messages.
constexpr std::size_t messages_per_look = 16;
/// Outboxes are scattered over memory: those of the next few targets are prefetched.
constexpr std::size_t looks_ahead = 4;

void fetch(const http::WebSocketSink* sink) {
  constexpr std::size_t line = 64;
  __builtin_prefetch(sink, 1);
  __builtin_prefetch(reinterpret_cast<const char*>(sink) + line, 1);
}

}  // namespace

void Slice::send(metrics::LatenessHistogram& lateness) {
  metrics::LatenessPart part(metrics::lateness_bounds);
  std::uint64_t handed = 0;
  const auto look = [&] {
    part.observe(std::chrono::duration<double>(Clock::now() - due_).count(), handed);
    handed = 0;
  };
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    auto& target = targets_[i];
    if (i + looks_ahead < targets_.size()) fetch(targets_[i + looks_ahead].sink);
    target.sent = target.sink->send(wires_[static_cast<std::size_t>(target.coding)], http::Purpose::state);
    if (target.sent == http::Sent::handed) ++handed;
    if (target.sent == http::Sent::refused) replaced_ += target.sink->drop_state() + 1;
    if (handed == messages_per_look) look();
  }
  look();
  lateness.add(part);
}

std::array<std::size_t, coding_count> FanOut::by_coding() const {
  std::array<std::size_t, coding_count> counts{};
  for (const auto& subscriber : subscribers_.all()) ++counts[static_cast<std::size_t>(subscriber.coding)];
  return counts;
}

void FanOut::count_sent(const http::WireMessage& message) {
  ++counts_.messages_sent;
  counts_.bytes_sent += message.bytes.size();
}

void FanOut::add(StreamPeer& client, http::WebSocketSink& sink, Coding coding, const http::WireMessage& begin,
                 bool waits, const BatchLog& log) {
  Subscriber subscriber;
  subscriber.client = &client;
  subscriber.sink = &sink;
  subscriber.slot = &client.notes().subscriber;
  subscriber.next_batch = log.batches() + 1;
  subscriber.coding = coding;
  subscriber.waits = waits;
  count_sent(begin);
  subscribers_.add(subscriber);
}

void FanOut::remove(StreamPeer& client) {
  if (client.notes().subscriber != Subscriber::nowhere) subscribers_.remove(client.notes().subscriber);
}

void FanOut::remove_all() {
  while (subscribers_.size() > 0) subscribers_.remove(subscribers_.size() - 1);
}

void FanOut::push(std::shared_ptr<Batch> batch) {
  if (subscribers_.size() > 0) passes_.push_back(std::move(batch));
}

bool FanOut::next_slice(Slice& slice, BatchLog& log) {
  if (passes_.empty()) return false;
  auto& batch = *passes_.front();
  slice.targets_.clear();
  slice.wires_ = {};
  slice.due_ = batch.due;
  slice.replaced_ = 0;
  for (auto& subscriber : subscribers_.next(slice_size)) {
    if (subscriber.next_batch > batch.number) continue;
    subscriber.next_batch = batch.number + 1;
    if (subscriber.behind) {
      ++counts_.messages_replaced;
      continue;
    }
    auto& wire = slice.wires_[static_cast<std::size_t>(subscriber.coding)];
    if (!wire) wire = log.wire(batch, subscriber.coding);
    slice.targets_.push_back({subscriber.sink, subscriber.client, subscriber.coding, http::Sent::refused});
  }
  return true;
}

void FanOut::finish_slice(Slice& slice, BatchLog& log) {
  counts_.messages_replaced += slice.replaced_;
  for (const auto& target : slice.targets_) {
    if (target.sent == http::Sent::closed) continue;
    if (target.sent != http::Sent::refused) {
      count_sent(*slice.wires_[static_cast<std::size_t>(target.coding)]);
      if (target.sent == http::Sent::handed) continue;
    }
    const auto slot = target.client->notes().subscriber;
    if (slot == Subscriber::nowhere) continue;  // removed meanwhile
    auto& subscriber = subscribers_[slot];
    subscriber.waits = true;
    if (target.sent != http::Sent::refused) continue;
    subscriber.behind = true;
    // The socket may have become writable meanwhile; no other event would report that.
    if (subscriber.sink->idle()) send_newest(subscriber, log);
  }
  slice.wires_ = {};
  if (!subscribers_.pass_done()) return;
  if (!passes_.empty()) passes_.pop_front();
  subscribers_.begin_pass();
}

void FanOut::send_rest(BatchLog& log) {
  for (const auto& batch : passes_) {
    for (auto& subscriber : subscribers_.all()) {
      if (subscriber.behind || subscriber.next_batch > batch->number) continue;
      const auto& wire = log.wire(*batch, subscriber.coding);
      subscriber.sink->send(wire, http::Purpose::state);
      count_sent(*wire);
    }
  }
  passes_.clear();
}

void FanOut::writable(StreamPeer& client, BatchLog& log) {
  const auto slot = client.notes().subscriber;
  if (slot == Subscriber::nowhere) return;
  auto& subscriber = subscribers_[slot];
  subscriber.waits = false;
  if (subscriber.behind) send_newest(subscriber, log);
}

void FanOut::send_newest(Subscriber& subscriber, BatchLog& log) {
  const auto& newest = log.join_point(subscriber.coding);
  const auto sent = subscriber.sink->send(newest, http::Purpose::state);
  if (sent == http::Sent::waits || sent == http::Sent::refused) subscriber.waits = true;
  if (sent == http::Sent::refused) return;  // the subscriber stays behind until its socket is writable
  subscriber.behind = false;
  subscriber.next_batch = log.batches() + 1;
  count_sent(*newest);
}

std::vector<StreamPeer*> FanOut::remove_stalled(std::chrono::milliseconds patience, Clock::time_point now) {
  std::vector<StreamPeer*> stalled;
  for (auto& subscriber : subscribers_.all()) {
    if (!subscriber.waits) continue;
    const auto since = subscriber.sink->stalled_since();
    if (!since)
      subscriber.waits = subscriber.behind;
    else if (now - *since > patience)
      stalled.push_back(subscriber.client);
  }
  for (auto* client : stalled) {
    counts_.messages_dropped += subscribers_[client->notes().subscriber].sink->drop_state();
    subscribers_.remove(client->notes().subscriber);
  }
  return stalled;
}

}  // namespace semblante::streams

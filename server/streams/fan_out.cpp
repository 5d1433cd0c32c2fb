#include "server/streams/fan_out.h"

#include <algorithm>
#include <span>
#include <utility>

#include "server/streams/stream_peer.h"

namespace semblante::streams {
namespace {

using Clock = FanOut::Clock;

/// Subscribers per slice, after which another stream has its turn.
constexpr std::size_t slice_size = 256;
/// The clock is read once per this number of messages.
constexpr std::size_t messages_per_look = 64;

}  // namespace

void Slice::send(http::GroupSender& sender, metrics::LatenessHistogram& lateness) {
  metrics::LatenessPart part(metrics::lateness_bounds);
  for (std::size_t begin = 0; begin < deliveries_.size(); begin += messages_per_look) {
    const auto group = std::span(deliveries_).subspan(begin, std::min(messages_per_look, deliveries_.size() - begin));
    sender.send(group);
    std::uint64_t handed = 0;
    for (const auto& delivery : group) {
      if (delivery.sent == http::Sent::handed) ++handed;
      if (delivery.sent == http::Sent::refused) replaced_ += delivery.sink->drop_state() + 1;
    }
    part.observe(std::chrono::duration<double>(Clock::now() - due_).count(), handed);
  }
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
  slice.deliveries_.clear();
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
    slice.targets_.push_back({subscriber.client, subscriber.coding});
    slice.deliveries_.push_back({subscriber.sink, &wire, http::Sent::refused});
  }
  return true;
}

void FanOut::finish_slice(Slice& slice, BatchLog& log) {
  counts_.messages_replaced += slice.replaced_;
  for (std::size_t i = 0; i < slice.targets_.size(); ++i) {
    const auto& target = slice.targets_[i];
    const auto sent = slice.deliveries_[i].sent;
    if (sent == http::Sent::closed) continue;
    if (sent != http::Sent::refused) {
      count_sent(*slice.wires_[static_cast<std::size_t>(target.coding)]);
      if (sent == http::Sent::handed) continue;
    }
    const auto slot = target.client->notes().subscriber;
    if (slot == Subscriber::nowhere) continue;  // removed meanwhile
    auto& subscriber = subscribers_[slot];
    subscriber.waits = true;
    if (sent != http::Sent::refused) continue;
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
  for (auto& subscriber : subscribers_.all()) {
    for (const auto& batch : passes_) {
      if (subscriber.behind) break;
      if (subscriber.next_batch > batch->number) continue;
      const auto& wire = log.wire(*batch, subscriber.coding);
      const auto sent = subscriber.sink->send(wire, http::Purpose::state);
      subscriber.behind = sent == http::Sent::refused;
      if (subscriber.behind) counts_.messages_replaced += subscriber.sink->drop_state() + 1;
      if (sent == http::Sent::handed || sent == http::Sent::waits) count_sent(*wire);
    }
    if (subscriber.behind) send_newest(subscriber, log);
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

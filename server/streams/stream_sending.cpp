// How a stream's frames become batches, and batches reach those who listen.

#include <algorithm>
#include <utility>

#include "protocol/cpp/frame_codec.h"
#include "server/streams/batch_sender.h"
#include "server/streams/encoding.h"
#include "server/streams/stream.h"
#include "server/streams/stream_connection.h"

namespace semblante::streams {
namespace {

using Clock = Stream::Clock;
/// So many subscribers are served before another stream has its turn.
constexpr std::size_t slice_size = 256;
/// Batches on their way at a time. When sending takes longer than the frames do, they are gathered into larger batches
/// rather than queued.
constexpr std::size_t most_passes = 4;
/// The clock is read once for so many messages.
constexpr std::size_t messages_per_look = 16;
/// Outboxes lie all over the memory: those that come next are fetched while one is served.
constexpr std::size_t looks_ahead = 4;

void fetch(const http::WebSocketSink* sink) {
  constexpr std::size_t line = 64;
  __builtin_prefetch(sink, 1);
  __builtin_prefetch(reinterpret_cast<const char*>(sink) + line, 1);
}

}  // namespace

void Stream::gather(std::uint64_t media_time, const std::vector<TimedFrame>& frames) {
  const auto now = Clock::now();
  auto& batch = gathering_;
  const auto fits = [&] {
    const auto last = batch.media_time + batch.frames.back().time;
    return batch.frames.size() + frames.size() <= max_frames_per_message && media_time + frames.front().time >= last &&
           media_time + frames.back().time - batch.media_time <= max_frame_time;
  };
  if (!batch.frames.empty() && !fits()) close_batch(now);
  if (batch.frames.empty()) {
    batch.sequence = info_.sequence - frames.size() + 1;
    batch.media_time = media_time;
    batch.frames = frames;
    // Batches of all streams are not due at the same moments, those of one stream are at even distances.
    const auto interval = std::chrono::milliseconds(info_.batch_interval);
    gather_due_ = info_.batch_interval == 0 ? now : began_ + ((now - began_) / interval + 1) * interval;
  } else {
    for (auto frame : frames) {
      frame.time += static_cast<std::uint32_t>(media_time - batch.media_time);
      batch.frames.push_back(frame);
    }
  }
  if (info_.batch_interval == 0 && may_close_batch()) close_batch(now);
  want(next_work(now));
}

bool Stream::may_close_batch() const { return !gathering_.frames.empty() && passes_.size() < most_passes; }

void Stream::close_batch(Clock::time_point due) {
  auto batch = std::make_shared<Batch>();
  batch->number = ++batches_;
  batch->message = std::exchange(gathering_, {});
  batch->before = packed_;
  batch->when = Clock::now();
  batch->due = due;
  keep_wire(*batch, Coding::packed, [&](std::string& wire) { append_payload(wire, packed_.encode(batch->message)); });
  ++counts_.batches;
  join_points_ = {};
  held_.push_back(batch);
  while (held_.size() > limits_.held_batches || batch->when - held_.front()->when > limits_.held_time)
    held_.pop_front();
  if (subscribers_.size() > 0) passes_.push_back(std::move(batch));
}

Clock::time_point Stream::next_work(Clock::time_point now) const {
  if (!passes_.empty()) return now;
  return gathering_.frames.empty() ? Clock::time_point::max() : gather_due_;
}

void Stream::want(Clock::time_point when) {
  if (when >= wanted_) return;
  wanted_ = when;
  if (sender_) sender_->wake(weak_from_this(), when);
}

const http::SharedWire& Stream::wire_of(Batch& batch, Coding coding) {
  auto& wire = batch.wires[static_cast<std::size_t>(coding)];
  if (wire) return wire;
  keep_wire(batch, coding, [&](std::string& bytes) {
    if (coding == Coding::json) {
      append_encoded(bytes, batch.message, false, steps_);
      return;
    }
    // The plain form says what changed: the encoder must know the face before.
    FrameEncoder encoder;
    encoder.encode(Keyframe{batch.before.sequence(), batch.before.media_time(), batch.before.state()});
    append_payload(bytes, encoder.encode(batch.message));
  });
  return wire;
}

template <class Write>
void Stream::keep_wire(Batch& batch, Coding coding, const Write& write) {
  const auto begin = Clock::now();
  http::WireMessage message;
  message.due = batch.due;
  message.lateness = lateness_;
  write(message.bytes);
  message.bytes.shrink_to_fit();
  batch.wires[static_cast<std::size_t>(coding)] = std::make_shared<const http::WireMessage>(std::move(message));
  counts_.encode_seconds += std::chrono::duration<double>(Clock::now() - begin).count();
}

const http::SharedWire& Stream::join_point(Coding coding) {
  auto& wire = join_points_[static_cast<std::size_t>(coding)];
  if (wire) return wire;
  const auto begin = Clock::now();
  http::WireMessage message;
  append_join_point(message.bytes, packed_, coding, steps_);
  wire = std::make_shared<const http::WireMessage>(std::move(message));
  counts_.encode_seconds += std::chrono::duration<double>(Clock::now() - begin).count();
  return wire;
}

Clock::time_point Stream::work(Clock::time_point asked) {
  {
    const std::lock_guard lock(mutex_);
    if (asked != wanted_) return Clock::time_point::max();
  }
  return advance(Clock::now());
}

Clock::time_point Stream::advance(Clock::time_point now) {
  const std::lock_guard pass(pass_mutex_);
  std::array<http::SharedWire, coding_count> wires;
  Clock::time_point due;
  {
    const std::lock_guard lock(mutex_);
    if (ended_) return wanted_ = Clock::time_point::max();
    if (may_close_batch() && now >= gather_due_) close_batch(gather_due_);
    if (passes_.empty()) return wanted_ = next_work(now);
    auto& batch = *passes_.front();
    due = batch.due;
    targets_.clear();
    for (auto& subscriber : subscribers_.next(slice_size)) {
      if (subscriber.next_batch > batch.number) continue;
      subscriber.next_batch = batch.number + 1;
      if (subscriber.behind) {
        ++counts_.messages_replaced;
        continue;
      }
      wires[static_cast<std::size_t>(subscriber.coding)] = wire_of(batch, subscriber.coding);
      targets_.push_back({subscriber.sink, subscriber.connection, subscriber.coding, http::Sent::handed});
    }
    in_slice_ = true;
  }
  const auto replaced = send_slice(targets_, wires, due);

  std::vector<std::shared_ptr<StreamConnection>> gone;  // their end is not for the mutex
  const std::lock_guard lock(mutex_);
  in_slice_ = false;
  gone.swap(parked_);
  counts_.messages_replaced += replaced;
  settle(targets_, wires);
  if (subscribers_.pass_done()) {
    if (!passes_.empty()) passes_.pop_front();
    subscribers_.begin_pass();
  }
  return wanted_ = next_work(now);
}

std::size_t Stream::send_slice(std::span<Target> targets, const std::array<http::SharedWire, coding_count>& wires,
                               Clock::time_point due) {
  std::size_t replaced = 0;
  metrics::LatenessPart lateness(metrics::lateness_bounds);
  std::uint64_t handed = 0;
  const auto look = [&] {
    lateness.observe(std::chrono::duration<double>(Clock::now() - due).count(), handed);
    handed = 0;
  };
  for (std::size_t i = 0; i < targets.size(); ++i) {
    auto& target = targets[i];
    if (i + looks_ahead < targets.size()) fetch(targets[i + looks_ahead].sink);
    target.sent = target.sink->send(wires[static_cast<std::size_t>(target.coding)], http::Purpose::state);
    if (target.sent == http::Sent::handed) ++handed;
    if (target.sent == http::Sent::refused) replaced += target.sink->drop_state() + 1;
    if (handed == messages_per_look) look();
  }
  look();
  lateness_->add(lateness);
  return replaced;
}

void Stream::settle(std::span<const Target> targets, const std::array<http::SharedWire, coding_count>& wires) {
  for (const auto& target : targets) {
    if (target.sent == http::Sent::closed) continue;
    if (target.sent != http::Sent::refused) {
      ++counts_.messages_sent;
      counts_.bytes_sent += wires[static_cast<std::size_t>(target.coding)]->bytes.size();
      if (target.sent == http::Sent::handed) continue;
    }
    const auto slot = target.connection->slots().subscriber;
    if (slot == Subscriber::nowhere) continue;
    auto& subscriber = subscribers_[slot];
    subscriber.waits = true;
    if (target.sent != http::Sent::refused) continue;
    subscriber.behind = true;
    // It may have become writable since; then nobody will say so again.
    if (subscriber.sink->idle()) rejoin(subscriber);
  }
}

}  // namespace semblante::streams

// Who listens to a stream: how they come, and go.

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/cpp/quantizers.h"
#include "server/streams/batch_listener.h"
#include "server/streams/encoding.h"
#include "server/streams/stream.h"
#include "server/streams/stream_connection.h"

namespace semblante::streams {
namespace {

constexpr double demo_frames_per_second = 25.0;

}  // namespace

bool Stream::admit(const std::shared_ptr<StreamConnection>& connection) {
  const std::lock_guard lock(mutex_);
  if (ended_ || connections_.size() >= limits_.max_connections) {
    ++counts_.refused;
    return false;
  }
  connection->slots().connection = connections_.size();
  connections_.push_back(connection);
  newcomers_.push_back(connection);
  return true;
}

void Stream::leave(StreamConnection& connection) {
  std::shared_ptr<StreamConnection> kept;  // its end is not for the mutex
  const std::lock_guard lock(mutex_);
  if (publisher_ == &connection) publisher_ = nullptr;
  auto& slots = connection.slots();
  if (slots.subscriber != Subscriber::nowhere) subscribers_.remove(slots.subscriber);
  if (slots.connection == Subscriber::nowhere) return;
  auto& place = connections_[slots.connection];
  kept = std::move(place);
  if (&place != &connections_.back()) {
    place = std::move(connections_.back());
    place->slots().connection = slots.connection;
  }
  connections_.pop_back();
  slots.connection = Subscriber::nowhere;
  if (in_slice_) parked_.push_back(std::move(kept));
}

Header Stream::make_header(bool recovered, StreamCoding coding) const {
  Header header;
  header.stream = info_.id;
  header.title = info_.title;
  header.model = info_.model;
  header.epoch = info_.epoch;
  header.sequence = packed_.sequence();
  header.media_time = media_time_now();
  header.server_time = server_time_now();
  if (const double rate = player_ != 0 ? rate_ : info_.source == "demo" ? demo_frames_per_second : 0.0; rate > 0.0) {
    header.fps_hint = rate;
    header.batch_interval = static_cast<std::uint32_t>(std::lround(1000.0 / rate));
  }
  header.batch_interval = std::max(header.batch_interval, info_.batch_interval);
  header.quantizers.assign(steps_.begin() + first_low_level_fap, steps_.end());
  header.recovered = recovered;
  header.coding = coding;
  header.viseme_share = info_.viseme_share;
  return header;
}

std::size_t Stream::find_held(const ResumePoint& resume) const {
  const auto first = std::find_if(held_.begin(), held_.end(),
                                  [&](const auto& batch) { return batch->message.sequence == resume.sequence + 1; });
  std::size_t frames = 0;
  for (auto batch = first; batch != held_.end(); ++batch) frames += (*batch)->message.frames.size();
  return frames > limits_.resumed_frames ? held_.size() : static_cast<std::size_t>(first - held_.begin());
}

http::SharedWire Stream::gap_from(std::size_t held, Coding coding) {
  const auto& first = *held_[held];
  http::WireMessage gap;
  append_join_point(gap.bytes, first.before, coding, steps_);
  for (; held < held_.size() && gap.bytes.size() <= limits_.resumed_bytes; ++held)
    gap.bytes.append(wire_of(*held_[held], coding)->bytes);
  if (gap.bytes.size() > limits_.resumed_bytes) return nullptr;
  return std::make_shared<const http::WireMessage>(std::move(gap));
}

void Stream::subscribe(StreamConnection& connection, const Hello& hello) {
  const std::lock_guard lock(mutex_);
  if (ended_ || connection.closing()) return;
  const bool packed = connection.binary() && hello.coding == StreamCoding::packed;
  const auto coding = packed ? Coding::packed : connection.binary() ? Coding::plain : Coding::json;
  // A client that comes back gets what it missed, if its last frame ended a batch that is still held (or is the
  // newest).
  http::SharedWire gap;
  bool recovered = hello.resume && hello.resume->epoch == info_.epoch && hello.resume->sequence == packed_.sequence();
  if (hello.resume && hello.resume->epoch == info_.epoch && !recovered) {
    if (const auto from = find_held(*hello.resume); from < held_.size()) gap = gap_from(from, coding);
    recovered = gap != nullptr;
  }
  connection.send(Message(make_header(recovered, packed ? StreamCoding::packed : StreamCoding::plain)));
  const auto& begin = gap ? gap : join_point(coding);
  const auto sent = connection.sink()->send(begin, http::Purpose::answer);
  if (sent == http::Sent::refused) {
    // It has read nothing of many answers before its hello. Batches without a beginning are no use to it.
    ++counts_.closed_slow;
    connection.close(Message(End{EndReason::slow}), {1013, "reads too slowly: come back later"});
    return;
  }
  Subscriber subscriber;
  subscriber.connection = &connection;
  subscriber.sink = connection.sink();
  subscriber.slot = &connection.slots().subscriber;
  subscriber.next_batch = batches_ + 1;
  subscriber.coding = coding;
  subscriber.waits = sent != http::Sent::handed;
  ++counts_.messages_sent;
  counts_.bytes_sent += begin->bytes.size();
  subscribers_.add(subscriber);
}

bool Stream::begin_publishing(StreamConnection& connection, bool take_over) {
  const std::lock_guard lock(mutex_);
  if (ended_) return false;
  if (!take_over && (player_ != 0 || publisher_ != nullptr)) {
    ++counts_.closed_conflict;
    return false;
  }
  replace_publisher();
  player_ = 0;
  publisher_ = &connection;
  timeline_.forget_publisher();
  connection.send(Message(make_header(false, StreamCoding::plain)));
  return true;
}

void Stream::end_publishing(const StreamConnection& connection) {
  const std::lock_guard lock(mutex_);
  if (publisher_ == &connection) publisher_ = nullptr;
}

void Stream::dismiss(StreamConnection& connection) {
  const std::lock_guard lock(mutex_);
  if (publisher_ != &connection) return;
  publisher_ = nullptr;
  last_live_ = Clock::now();
  ++counts_.closed_flooding;
}

void Stream::writable(StreamConnection& connection) {
  const std::lock_guard lock(mutex_);
  const auto slot = connection.slots().subscriber;
  if (slot == Subscriber::nowhere) return;
  auto& subscriber = subscribers_[slot];
  subscriber.waits = false;
  if (subscriber.behind) rejoin(subscriber);
}

void Stream::rejoin(Subscriber& subscriber) {
  const auto& now = join_point(subscriber.coding);
  const auto sent = subscriber.sink->send(now, http::Purpose::state);
  if (sent == http::Sent::waits || sent == http::Sent::refused) subscriber.waits = true;
  if (sent == http::Sent::refused) return;  // it stays behind until it can be written to
  subscriber.behind = false;
  subscriber.next_batch = batches_ + 1;
  ++counts_.messages_sent;
  counts_.bytes_sent += now->bytes.size();
}

void Stream::count_throttled(std::size_t frames) {
  const std::lock_guard lock(mutex_);
  counts_.throttled += frames;
}

void Stream::tell_end(StreamConnection& connection, EndReason reason) {
  const bool stops = reason == EndReason::shutdown;
  connection.close(Message(End{reason}), {static_cast<std::uint16_t>(stops ? 1001 : 1000),
                                          stops ? "the server stops" : "the stream has ended"});
}

void Stream::end(EndReason reason) {
  // Whoever sends a slice has finished: what follows comes behind it.
  const std::lock_guard pass(pass_mutex_);
  const std::lock_guard lock(mutex_);
  if (ended_) return;
  if (!gathering_.frames.empty()) close_batch(Clock::now());
  for (const auto& batch : passes_) {
    for (auto& subscriber : subscribers_.all()) {
      if (subscriber.behind || subscriber.next_batch > batch->number) continue;
      subscriber.sink->send(wire_of(*batch, subscriber.coding), http::Purpose::state);
      ++counts_.messages_sent;
    }
  }
  passes_.clear();
  if (listener_) listener_->ended(info_.id);
  ended_ = true;
  for (const auto& connection : connections_) tell_end(*connection, reason);
  counts_.closed_ended += connections_.size();
  while (subscribers_.size() > 0) subscribers_.remove(subscribers_.size() - 1);
}

void Stream::look_after_connections() {
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  std::vector<StreamConnection*> stalled;
  for (auto& subscriber : subscribers_.all()) {
    if (!subscriber.waits) continue;
    const auto since = subscriber.sink->stalled_since();
    if (!since)
      subscriber.waits = subscriber.behind;
    else if (now - *since > limits_.stalled)
      stalled.push_back(subscriber.connection);
  }
  for (auto* connection : stalled) {
    ++counts_.closed_slow;
    counts_.messages_dropped += connection->sink()->drop_state();
    subscribers_.remove(connection->slots().subscriber);
    connection->close(Message(End{EndReason::slow}), {1013, "reads too slowly: come back later"});
  }
  while (!newcomers_.empty()) {
    const auto connection = newcomers_.front().lock();
    if (connection && now - connection->began() <= limits_.hello_time) break;
    newcomers_.pop_front();
    if (!connection || connection->said_hello() || connection->closing()) continue;
    ++counts_.closed_silent;
    connection->close(Message(StreamError{StreamErrorCode::missing, "", "no hello came in time"}),
                      {1008, "no hello came in time"});
  }
}

}  // namespace semblante::streams

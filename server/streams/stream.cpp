#include "server/streams/stream.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/cpp/fap_ranges.h"
#include "protocol/cpp/json_codec.h"
#include "protocol/cpp/quantizers.h"
#include "server/streams/batch_listener.h"
#include "server/streams/stream_connection.h"

namespace semblante::streams {
namespace {

using Clock = Stream::Clock;
constexpr double demo_frames_per_second = 25.0;
/// A stream's own source comes back when nobody has published for so long.
constexpr std::chrono::seconds demo_patience{3};
/// A publisher's clock may run ahead of or behind the stream's by so much before it is set anew.
constexpr std::int64_t clock_ahead = 10'000;
constexpr std::int64_t clock_behind = 1'000;

SharedBytes shared(const std::vector<std::uint8_t>& bytes) {
  return std::make_shared<const std::string>(bytes.begin(), bytes.end());
}

}  // namespace

Stream::Stream(StreamInfo info, StreamLimits limits) : limits_(limits), info_(std::move(info)) {
  // The encoder writes what changed: it begins at the neutral face, as every late joiner's keyframe does.
  encoder_.encode(Keyframe{});
}

double Stream::server_time_now() {
  return std::chrono::duration<double, std::milli>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::uint64_t Stream::media_time_now() const { return media_time_at(Clock::now()); }

std::uint64_t Stream::media_time_at(Clock::time_point when) const {
  const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(when - began_).count();
  return static_cast<std::uint64_t>(std::max<std::int64_t>(since, 0));
}

StreamInfo Stream::info() const {
  const std::lock_guard lock(mutex_);
  StreamInfo info = info_;
  info.publishers = publisher_ != nullptr ? 1 : 0;
  info.subscribers = static_cast<std::size_t>(std::count_if(
      connections_.begin(), connections_.end(), [](const auto& connection) { return connection->subscribed(); }));
  return info;
}

StreamCounts Stream::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

void Stream::set_listener(std::shared_ptr<BatchListener> listener) {
  const std::lock_guard lock(mutex_);
  listener_ = std::move(listener);
}

std::uint64_t Stream::place_played(Clock::time_point when) const {
  const auto at = media_time_at(when);
  const bool just_behind = media_time_ > at && media_time_ - at < static_cast<std::uint64_t>(clock_behind);
  return just_behind ? media_time_ : at;
}

std::uint64_t Stream::place_in_time(Source source, std::uint64_t media_time) {
  const auto now = static_cast<std::int64_t>(media_time_now());
  if (source != Source::connection || media_time == 0) return static_cast<std::uint64_t>(now);
  // The publisher's own spacing is kept, so that a jittery network does not make a jittery face.
  const auto theirs = static_cast<std::int64_t>(std::min<std::uint64_t>(media_time, INT64_MAX / 2));
  const auto ours = theirs + publisher_offset_;
  if (!publisher_offset_known_ || ours > now + clock_ahead || ours < now - clock_behind) {
    publisher_offset_ = now - theirs;
    publisher_offset_known_ = true;
    return static_cast<std::uint64_t>(now);
  }
  return static_cast<std::uint64_t>(std::max<std::int64_t>(ours, 0));
}

Result<PublishReceipt> Stream::publish(Source source, std::uint64_t media_time, const std::vector<TimedFrame>& frames) {
  if (frames.empty()) return Error{ErrorCode::empty, "/frames", "there is no frame in it"};
  const std::lock_guard lock(mutex_);
  if (ended_) return Error{ErrorCode::missing, "", "the stream has ended"};
  if (source == Source::request && publisher_ != nullptr)
    return Error{ErrorCode::mismatch, "", "a connection publishes to this stream: one source at a time"};
  if (player_ != 0) return Error{ErrorCode::mismatch, "", "a performance plays into this stream: one source at a time"};
  last_live_ = Clock::now();
  return take(place_in_time(source, media_time), frames);
}

PublishReceipt Stream::take(std::uint64_t media_time, const std::vector<TimedFrame>& frames) {
  Batch batch;
  batch.message.sequence = info_.sequence + 1;
  batch.message.media_time = media_time;
  batch.message.frames = frames;
  std::size_t clamped = 0;
  for (auto& frame : batch.message.frames) clamped += clamp_to_ranges(frame.state);
  info_.clamped_values += clamped;
  counts_.clamped_values += clamped;
  batch.state_before = state_;
  batch.binary = shared(encoder_.encode(batch.message));
  batch.when = Clock::now();
  info_.sequence += frames.size();
  state_ = batch.message.frames.back().state;
  media_time_ = batch.message.media_time + frames.back().time;
  counts_.frames += frames.size();
  held_.push_back(std::move(batch));
  while (held_.size() > limits_.held_batches || Clock::now() - held_.front().when > limits_.held_time)
    held_.pop_front();

  if (listener_) listener_->taken(info_.id, info_.epoch, held_.back().message);
  for (const auto& connection : connections_) {
    if (!connection->subscribed()) continue;
    counts_.messages_replaced += connection->send(encoded(held_.back(), connection->binary()));
    ++counts_.messages_sent;
  }
  return PublishReceipt{frames.size(), info_.sequence, clamped};
}

Result<std::uint64_t> Stream::begin_playing(double rate, bool take_over) {
  const std::lock_guard lock(mutex_);
  if (ended_) return Error{ErrorCode::missing, "", "the stream has ended"};
  if (!take_over && publisher_ != nullptr)
    return Error{ErrorCode::mismatch, "", "a connection publishes to this stream: one source at a time"};
  if (!take_over && player_ != 0)
    return Error{ErrorCode::mismatch, "", "something plays into this stream already: one source at a time"};
  if (publisher_ != nullptr) {
    publisher_->close(Message(End{EndReason::replaced}), {1000, "another source took over"});
    publisher_ = nullptr;
  }
  rate_ = rate;
  player_ = ++last_ticket_;
  return player_;
}

Status Stream::publish_playing(std::uint64_t ticket, Clock::time_point when, const TimedFrame& frame) {
  const std::lock_guard lock(mutex_);
  if (ended_ || ticket != player_) return Error{ErrorCode::mismatch, "", "it plays no more"};
  last_live_ = Clock::now();
  take(place_played(when), {frame});
  return Unit{};
}

void Stream::end_playing(std::uint64_t ticket, bool neutral) {
  const std::lock_guard lock(mutex_);
  if (ended_ || ticket != player_) return;
  player_ = 0;
  last_live_ = Clock::now();
  if (neutral) take(place_played(Clock::now()), {TimedFrame{}});
}

Status Stream::fill(Clock::time_point when, const TimedFrame& frame) {
  const std::lock_guard lock(mutex_);
  if (ended_) return Error{ErrorCode::missing, "", "the stream has ended"};
  if (publisher_ != nullptr || player_ != 0 || Clock::now() - last_live_ < demo_patience) return Unit{};
  take(place_played(when), {frame});
  return Unit{};
}

const SharedBytes& Stream::encoded(Batch& batch, bool binary) const {
  if (binary) return batch.binary;
  if (!batch.json) batch.json = std::make_shared<const std::string>(encode_json(batch.message));
  return batch.json;
}

bool Stream::admit(const std::shared_ptr<StreamConnection>& connection) {
  const std::lock_guard lock(mutex_);
  if (ended_ || connections_.size() >= limits_.max_connections) {
    ++counts_.refused;
    return false;
  }
  connections_.push_back(connection);
  return true;
}

void Stream::leave(StreamConnection& connection) {
  const std::lock_guard lock(mutex_);
  if (publisher_ == &connection) publisher_ = nullptr;
  std::erase_if(connections_, [&](const auto& item) { return item.get() == &connection; });
}

Header Stream::make_header(bool recovered) const {
  Header header;
  header.stream = info_.id;
  header.title = info_.title;
  header.model = info_.model;
  header.epoch = info_.epoch;
  header.sequence = info_.sequence;
  header.media_time = media_time_now();
  header.server_time = server_time_now();
  if (const double rate = player_ != 0 ? rate_ : info_.source == "demo" ? demo_frames_per_second : 0.0; rate > 0.0) {
    header.fps_hint = rate;
    header.batch_interval = static_cast<std::uint32_t>(std::lround(1000.0 / rate));
  }
  const auto& steps = standard_quantizers();
  header.quantizers.assign(steps.begin() + first_low_level_fap, steps.end());
  header.recovered = recovered;
  header.viseme_share = info_.viseme_share;
  return header;
}

void Stream::send_keyframe(StreamConnection& connection, std::uint64_t sequence, std::uint64_t media_time,
                           const FaceFrame& state) const {
  connection.send(Message(Keyframe{sequence, media_time, state}));
}

void Stream::subscribe(StreamConnection& connection, const Hello& hello) {
  const std::lock_guard lock(mutex_);
  // A client that comes back gets what it missed, if its last frame ended a batch that is still held (or is the
  // newest).
  std::size_t from = held_.size();
  bool recovered = hello.resume && hello.resume->epoch == info_.epoch && hello.resume->sequence == info_.sequence;
  if (hello.resume && hello.resume->epoch == info_.epoch && !recovered) {
    const auto next = std::find_if(held_.begin(), held_.end(), [&](const Batch& batch) {
      return batch.message.sequence == hello.resume->sequence + 1;
    });
    recovered = next != held_.end() && static_cast<std::size_t>(held_.end() - next) < limits_.pending_messages;
    if (recovered) from = static_cast<std::size_t>(next - held_.begin());
  }
  connection.send(Message(make_header(recovered)));
  if (from < held_.size()) {
    send_keyframe(connection, hello.resume->sequence, held_[from].message.media_time, held_[from].state_before);
    for (; from < held_.size(); ++from) connection.send(encoded(held_[from], connection.binary()));
  } else {
    send_keyframe(connection, info_.sequence, media_time_, state_);
  }
  connection.set_subscribed();
}

bool Stream::begin_publishing(StreamConnection& connection) {
  const std::lock_guard lock(mutex_);
  if (player_ != 0 || (publisher_ != nullptr && publisher_ != &connection)) {
    ++counts_.refused;
    return false;
  }
  publisher_ = &connection;
  publisher_offset_known_ = false;
  connection.send(Message(make_header(false)));
  return true;
}

void Stream::catch_up(StreamConnection& connection) {
  const std::lock_guard lock(mutex_);
  connection.resume_with(Message(Keyframe{info_.sequence, media_time_, state_}));
}

void Stream::end(EndReason reason) {
  const std::lock_guard lock(mutex_);
  if (listener_ && !ended_) listener_->ended(info_.id);
  ended_ = true;
  const std::uint16_t code = reason == EndReason::shutdown ? 1001 : 1000;
  const char* words = reason == EndReason::shutdown ? "the server stops" : "the stream has ended";
  for (const auto& connection : connections_) connection->close(Message(End{reason}), {code, words});
}

void Stream::look_after_connections() {
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  for (const auto& connection : connections_) {
    if (connection->closing()) continue;
    const auto stalled = connection->stalled_since();
    if (stalled && now - *stalled > limits_.stalled) {
      ++counts_.closed_slow;
      connection->close(Message(End{EndReason::slow}), {1013, "reads too slowly: come back later"});
    } else if (!connection->said_hello() && now - connection->began() > limits_.hello_time) {
      connection->close(Message(StreamError{StreamErrorCode::missing, "", "no hello came in time"}),
                        {1008, "no hello came in time"});
    }
  }
}

}  // namespace semblante::streams

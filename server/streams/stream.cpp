#include "server/streams/stream.h"

#include <algorithm>
#include <utility>

#include "protocol/cpp/fap_ranges.h"
#include "server/streams/batch_listener.h"
#include "server/streams/stream_connection.h"

namespace semblante::streams {
namespace {

using Clock = Stream::Clock;
/// A stream's own source comes back when nobody has published for so long.
constexpr std::chrono::seconds demo_patience{3};
/// A publisher's clock may run ahead of or behind the stream's by so much before it is set anew.
constexpr std::int64_t clock_ahead = 10'000;
constexpr std::int64_t clock_behind = 1'000;

}  // namespace

/// Without a sender there is nobody else to send what was taken: done where the mutex has been left. Declared before
/// the lock.
class Stream::SendAfter {
 public:
  explicit SendAfter(Stream& stream) : stream_(stream) {}
  ~SendAfter() {
    if (stream_.sender_) return;
    auto now = Clock::now();
    while (stream_.advance(now) <= now) now = Clock::now();
  }
  SendAfter(const SendAfter&) = delete;
  SendAfter& operator=(const SendAfter&) = delete;

 private:
  Stream& stream_;
};

Stream::Stream(StreamInfo info, StreamLimits limits, std::shared_ptr<BatchSender> sender)
    : limits_(limits),
      sender_(std::move(sender)),
      lateness_(std::make_shared<metrics::LatenessHistogram>(metrics::lateness_bounds)),
      info_(std::move(info)) {}

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
  info.subscribers = subscribers_.size();
  return info;
}

StreamCounts Stream::counts() const {
  const std::lock_guard lock(mutex_);
  StreamCounts counts = counts_;
  counts.messages_dropped += dropped_;
  counts.lateness = lateness_->values();
  return counts;
}

void Stream::set_listener(std::shared_ptr<BatchListener> listener) {
  const std::lock_guard lock(mutex_);
  listener_ = std::move(listener);
}

std::uint64_t Stream::place_played(Clock::time_point when) const {
  const auto at = media_time_at(when);
  const auto newest = newest_media_time_;
  const bool just_behind = newest > at && newest - at < static_cast<std::uint64_t>(clock_behind);
  return just_behind ? newest : at;
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
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  if (ended_) return Error{ErrorCode::missing, "", "the stream has ended"};
  if (source == Source::request && publisher_ != nullptr)
    return Error{ErrorCode::mismatch, "", "a connection publishes to this stream: one source at a time"};
  if (player_ != 0) return Error{ErrorCode::mismatch, "", "a performance plays into this stream: one source at a time"};
  last_live_ = Clock::now();
  return take(place_in_time(source, media_time), frames);
}

PublishReceipt Stream::take(std::uint64_t media_time, const std::vector<TimedFrame>& frames) {
  std::vector<TimedFrame> within = frames;
  std::size_t clamped = 0;
  for (auto& frame : within) clamped += clamp_to_ranges(frame.state);
  info_.clamped_values += clamped;
  counts_.clamped_values += clamped;
  counts_.frames += frames.size();
  info_.sequence += frames.size();
  newest_media_time_ = media_time + frames.back().time;
  gather(media_time, within);
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
    ++counts_.closed_replaced;
  }
  rate_ = rate;
  player_ = ++last_ticket_;
  return player_;
}

Status Stream::publish_playing(std::uint64_t ticket, Clock::time_point when, const TimedFrame& frame) {
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  if (ended_ || ticket != player_) return Error{ErrorCode::mismatch, "", "it plays no more"};
  last_live_ = Clock::now();
  take(place_played(when), {frame});
  return Unit{};
}

void Stream::end_playing(std::uint64_t ticket, bool neutral) {
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  if (ended_ || ticket != player_) return;
  player_ = 0;
  last_live_ = Clock::now();
  if (neutral) take(place_played(Clock::now()), {TimedFrame{}});
}

Status Stream::fill(Clock::time_point when, const TimedFrame& frame) {
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  if (ended_) return Error{ErrorCode::missing, "", "the stream has ended"};
  if (publisher_ != nullptr || player_ != 0 || Clock::now() - last_live_ < demo_patience) return Unit{};
  take(place_played(when), {frame});
  return Unit{};
}

}  // namespace semblante::streams

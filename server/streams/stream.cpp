#include "server/streams/stream.h"

#include <algorithm>
#include <utility>

#include "protocol/cpp/fap_ranges.h"
#include "server/streams/batch_listener.h"
#include "server/streams/stream_connection.h"

namespace semblante::streams {
namespace {

using Clock = Stream::Clock;

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
      steps_(scaled_quantizers(info.quantizer_scale)),
      sender_(std::move(sender)),
      lateness_(std::make_shared<metrics::LatenessHistogram>(metrics::lateness_bounds)),
      info_(std::move(info)),
      requests_(limits.publisher, Clock::now()) {}

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
  for (const auto& subscriber : subscribers_.all())
    ++info.subscribers_by_coding[static_cast<std::size_t>(subscriber.coding)];
  info.active_source = active_source();
  info.counts = counts_;
  info.counts.lateness = lateness_->values();
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

Clock::time_point Stream::newest_frame_time() const {
  const std::lock_guard lock(mutex_);
  return began_ + std::chrono::milliseconds(timeline_.newest());
}

Result<PublishReceipt> Stream::publish(Source source, std::uint64_t media_time, const std::vector<TimedFrame>& frames,
                                       const StreamConnection* from) {
  if (frames.empty()) return Error{ErrorCode::empty, "/frames", "there is no frame in it"};
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  if (ended_) return Error{ErrorCode::missing, "", "the stream has ended"};
  if (publisher_ != from)
    return Error{ErrorCode::mismatch, "", "a connection publishes to this stream: one source at a time"};
  if (player_ != 0)
    return Error{ErrorCode::mismatch, "",
                 "a " + std::string(source_names[static_cast<std::size_t>(playing_)]) +
                     " plays into this stream: one source at a time"};
  const bool request = source == Source::request;
  if (request && requests_.offer(frames.size(), Clock::now()) != FloodGuard::Verdict::take) {
    counts_.throttled += frames.size();
    return Error{ErrorCode::too_large, "/frames", requests_.words()};
  }
  const auto now = media_time_now();
  auto placed = frames;
  const auto at = request || media_time == 0 ? timeline_.place_now(now, placed)
                                             : timeline_.place_published(now, media_time, placed);
  if (!at) return at.error();
  last_live_ = Clock::now();
  last_was_request_ = request;
  return take(source, *at, std::move(placed));
}

PublishReceipt Stream::take(Source source, std::uint64_t media_time, std::vector<TimedFrame> frames) {
  std::size_t clamped = 0;
  for (auto& frame : frames) clamped += clamp_to_ranges(frame.state, info_.quantizer_scale);
  info_.clamped_values += clamped;
  counts_.clamped_values += clamped;
  counts_.frames += frames.size();
  counts_.frames_by_source[static_cast<std::size_t>(source)] += frames.size();
  info_.sequence += frames.size();
  // Before they are gathered: what a client was told is taken must not still be on its way when a recording ends.
  if (listener_) listener_->taken(info_.id, info_.epoch, {info_.sequence - frames.size() + 1, media_time, frames});
  gather(media_time, frames);
  return PublishReceipt{frames.size(), info_.sequence, clamped};
}

void Stream::replace_publisher() {
  if (publisher_ == nullptr) return;
  publisher_->close(Message(End{EndReason::replaced}), {1000, "another source took over"});
  publisher_ = nullptr;
  ++counts_.closed_replaced;
}

std::optional<Source> Stream::active_source() const {
  if (publisher_ != nullptr) return Source::connection;
  if (player_ != 0) return playing_;
  if (last_was_request_ && Clock::now() - last_live_ < limits_.demo_patience) return Source::request;
  if (info_.source == "demo") return Source::demo;
  return std::nullopt;
}

Result<std::uint64_t> Stream::begin_playing(double rate, bool take_over, Source source) {
  const std::lock_guard lock(mutex_);
  if (ended_) return Error{ErrorCode::missing, "", "the stream has ended"};
  if (!take_over && publisher_ != nullptr)
    return Error{ErrorCode::mismatch, "", "a connection publishes to this stream: one source at a time"};
  if (!take_over && player_ != 0)
    return Error{ErrorCode::mismatch, "", "something plays into this stream already: one source at a time"};
  replace_publisher();
  rate_ = rate;
  playing_ = source;
  player_ = ++last_ticket_;
  return player_;
}

Status Stream::publish_playing(std::uint64_t ticket, Clock::time_point when, const TimedFrame& frame) {
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  if (ended_ || ticket == 0 || ticket != player_) return Error{ErrorCode::mismatch, "", "it plays no more"};
  last_live_ = Clock::now();
  last_was_request_ = false;
  take(playing_, timeline_.place_due(media_time_at(when)), {frame});
  return Unit{};
}

void Stream::end_playing(std::uint64_t ticket, bool neutral) {
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  if (ended_ || ticket == 0 || ticket != player_) return;
  player_ = 0;
  last_live_ = Clock::now();
  if (neutral) take(playing_, timeline_.place_due(media_time_now()), {TimedFrame{}});
}

Status Stream::fill(Clock::time_point when, const TimedFrame& frame) {
  const SendAfter after(*this);
  const std::lock_guard lock(mutex_);
  if (ended_) return Error{ErrorCode::missing, "", "the stream has ended"};
  if (publisher_ != nullptr || player_ != 0 || Clock::now() - last_live_ < limits_.demo_patience) return Unit{};
  take(Source::demo, timeline_.place_due(media_time_at(when)), {frame});
  return Unit{};
}

}  // namespace semblante::streams

#include "server/streams/batch_log.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace semblante::streams {
namespace {

using Clock = BatchLog::Clock;

/// Whether frames from `media_time` on can be appended to `batch` without breaking the limits of one message.
bool fits(const Frames& batch, std::uint64_t media_time, const std::vector<TimedFrame>& frames) {
  const auto last = batch.media_time + batch.frames.back().time;
  return batch.frames.size() + frames.size() <= max_frames_per_message && media_time + frames.front().time >= last &&
         media_time + frames.back().time - batch.media_time <= max_frame_time;
}

}  // namespace

BatchLog::BatchLog(BatchLogOptions options) : options_(std::move(options)) {}

std::shared_ptr<Batch> BatchLog::add(std::uint64_t media_time, const std::vector<TimedFrame>& frames,
                                     Clock::time_point now) {
  assert(!frames.empty());
  std::shared_ptr<Batch> full;
  if (!gathering_.frames.empty() && !fits(gathering_, media_time, frames)) full = close(now, now);
  if (gathering_.frames.empty()) {
    gathering_.sequence = taken_ + 1;
    gathering_.media_time = media_time;
    gathering_.frames = frames;
    // Batches are due at multiples of the interval since the stream began, so that those of one stream are evenly
    // spaced and those of different streams are due at different times.
    const auto interval = options_.interval;
    due_ = interval.count() == 0 ? now : options_.began + ((now - options_.began) / interval + 1) * interval;
  } else {
    for (auto frame : frames) {
      frame.time += static_cast<std::uint32_t>(media_time - gathering_.media_time);
      gathering_.frames.push_back(frame);
    }
  }
  taken_ += frames.size();
  return full;
}

std::shared_ptr<Batch> BatchLog::close(Clock::time_point due, Clock::time_point now) {
  assert(!gathering_.frames.empty());
  auto batch = std::make_shared<Batch>();
  batch->number = ++batches_;
  batch->message = std::exchange(gathering_, {});
  batch->before = packed_;
  batch->closed = now;
  batch->due = due;
  batch->wires[static_cast<std::size_t>(Coding::packed)] = encode(
      due, options_.lateness, [&](std::string& bytes) { append_payload(bytes, packed_.encode(batch->message)); });
  join_points_ = {};
  held_.push_back(batch);
  while (held_.size() > options_.limits.held_batches || now - held_.front()->closed > options_.limits.held_time)
    held_.pop_front();
  return batch;
}

template <class Write>
http::SharedWire BatchLog::encode(Clock::time_point due, const std::shared_ptr<metrics::LatenessHistogram>& lateness,
                                  const Write& write) {
  const auto begin = Clock::now();
  http::WireMessage message;
  message.due = due;
  message.lateness = lateness;
  write(message.bytes);
  message.bytes.shrink_to_fit();
  auto wire = std::make_shared<const http::WireMessage>(std::move(message));
  encode_seconds_ += std::chrono::duration<double>(Clock::now() - begin).count();
  return wire;
}

const http::SharedWire& BatchLog::wire(Batch& batch, Coding coding) {
  auto& wire = batch.wires[static_cast<std::size_t>(coding)];
  if (wire) return wire;
  return wire = encode(batch.due, options_.lateness,
                       [&](std::string& bytes) { append_encoded(bytes, batch.message, false, options_.steps); });
}

const http::SharedWire& BatchLog::join_point(Coding coding) {
  auto& wire = join_points_[static_cast<std::size_t>(coding)];
  if (wire) return wire;
  return wire = encode({}, nullptr,
                       [&](std::string& bytes) { append_join_point(bytes, packed_, coding, options_.steps); });
}

Beginning BatchLog::begin(Coding coding, const std::optional<ResumePoint>& resume) {
  if (resume && resume->epoch == options_.epoch) {
    if (resume->sequence == sequence()) return {join_point(coding), true};
    if (const auto from = find_held(*resume); from < held_.size()) {
      if (auto gap = gap_from(from, coding)) return {std::move(gap), true};
    }
  }
  return {join_point(coding), false};
}

std::size_t BatchLog::find_held(const ResumePoint& resume) const {
  const auto first = std::find_if(held_.begin(), held_.end(),
                                  [&](const auto& batch) { return batch->message.sequence == resume.sequence + 1; });
  std::size_t frames = 0;
  for (auto batch = first; batch != held_.end(); ++batch) frames += (*batch)->message.frames.size();
  return frames > options_.limits.resumed_frames ? held_.size() : static_cast<std::size_t>(first - held_.begin());
}

http::SharedWire BatchLog::gap_from(std::size_t held, Coding coding) {
  const auto most = options_.limits.resumed_bytes;
  std::size_t size = 0;
  for (auto i = held; i < held_.size() && size <= most; ++i) size += wire(*held_[i], coding)->bytes.size();
  if (size > most) return nullptr;
  auto gap = encode({}, nullptr, [&](std::string& bytes) {
    append_join_point(bytes, held_[held]->before, coding, options_.steps);
    for (auto i = held; i < held_.size(); ++i) bytes.append(wire(*held_[i], coding)->bytes);
  });
  return gap->bytes.size() > most ? nullptr : gap;
}

}  // namespace semblante::streams

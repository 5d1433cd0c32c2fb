#include <algorithm>
#include <cmath>

#include "clients/runtime/stream.h"
#include "protocol/cpp/face_frame.h"
#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/opus_packet.h"

namespace semblante::runtime {
namespace {

/// Farthest time of a frame after the media time of its message, ms, as servers allow.
constexpr double farthest_frame = 10'000;

bool is_media_time(double time) { return time >= 0 && time <= static_cast<double>(max_media_time); }

bool is_publishable(std::span<const semblante_timed_frame> frames, double media_time) {
  if (frames.empty() || frames.size() > max_frames_per_message) return false;
  if (!is_media_time(media_time)) return false;
  double before = 0;
  for (const auto& [time, frame] : frames) {
    if (!(time >= before && time <= farthest_frame)) return false;
    before = time;
    if (!std::all_of(std::begin(frame.fap), std::end(frame.fap), [](float f) { return std::isfinite(f); }))
      return false;
    if (!is_valid(quantized(frame, standard_quantizers()))) return false;  // visemes and expressions
  }
  return true;
}

}  // namespace

Stream::Published Stream::publish(std::span<const semblante_timed_frame> frames, double media_time, double now) {
  if (options_.role != StreamRole::publish || !is_publishable(frames, media_time)) return Published::invalid;
  if (!greeted_ || ended_ || outbox_.waiting() > most_waiting) return Published::unavailable;
  // A batch needs times of its own; the origin of a publisher's clock does not matter.
  if (options_.batch > 0 && media_time == 0) media_time = std::max(1.0, now);
  const auto base = static_cast<std::uint64_t>(std::llround(media_time));
  for (const auto& [time, frame] : frames) {
    add_to_batch({static_cast<std::uint32_t>(std::lround(time)), quantized(frame, steps_)}, base, now);
  }
  if (!(options_.batch > 0)) flush();
  return Published::sent;
}

Stream::Published Stream::publish_sound(std::span<const std::uint8_t> packet, double media_time) {
  if (options_.role != StreamRole::publish || !options_.sound || !is_media_time(media_time) ||
      packet.size() > max_sound_packet_bytes || !opus_packet_ms(packet))
    return Published::invalid;
  if (!greeted_ || ended_ || !header_->sound || outbox_.waiting() > most_waiting) return Published::unavailable;
  // Not after the frames of its batch: it can be used as soon as it comes.
  send(SoundPacket{static_cast<std::uint64_t>(std::llround(media_time)), {packet.begin(), packet.end()}});
  return Published::sent;
}

void Stream::add_to_batch(const TimedFrame& frame, std::uint64_t media_time, double now) {
  if (batch_.frames.empty()) {
    batch_.media_time = media_time;
    batch_until_ = now + options_.batch;
  }
  const std::uint64_t at = media_time + frame.time;
  const std::uint64_t newest = batch_.media_time + (batch_.frames.empty() ? 0 : batch_.frames.back().time);
  const bool fits = at >= newest && static_cast<double>(at - batch_.media_time) <= farthest_frame &&
                    batch_.frames.size() < max_frames_per_message;
  if (!fits) {
    flush();
    return add_to_batch(frame, media_time, now);
  }
  batch_.frames.push_back({static_cast<std::uint32_t>(at - batch_.media_time), frame.state});
}

void Stream::flush() {
  batch_until_ = never;
  if (batch_.frames.empty()) return;
  batch_.sequence = 0;
  if (!encoder_) {
    // Later messages are differences, so the first frame of a connection is a keyframe.
    const TimedFrame& first = batch_.frames.front();
    const Keyframe keyframe{0, batch_.media_time == 0 ? 0 : batch_.media_time + first.time, first.state};
    encoder_.emplace(keyframe);
    if (options_.encode != nullptr) {
      send(keyframe);
    } else {
      const std::vector<std::uint8_t> bytes = encoder_->keyframe();
      outbox_.bytes().insert(outbox_.bytes().end(), bytes.begin(), bytes.end());
      outbox_.end_message();
    }
    batch_.frames.erase(batch_.frames.begin());
  }
  if (!batch_.frames.empty()) {
    if (options_.encode != nullptr) {
      send(batch_);
    } else {
      encoder_->encode(batch_, outbox_.bytes());
      outbox_.end_message();
    }
  }
  batch_.frames.clear();
}

}  // namespace semblante::runtime

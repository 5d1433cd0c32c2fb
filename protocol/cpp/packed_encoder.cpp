#include <cassert>

#include "protocol/cpp/byte_io.h"
#include "protocol/cpp/packed_codec.h"
#include "protocol/cpp/packed_model.h"
#include "protocol/cpp/range_coder.h"

namespace semblante {

PackedEncoder::PackedEncoder(const Keyframe& start, const PackedTable& table) : table_(&table) {
  assert(is_valid(start.state) && start.sequence <= max_media_time && start.media_time <= max_media_time);
  state_.before.fill(start.state);
  state_.sequence = start.sequence;
  state_.media_time = start.media_time;
}

std::vector<std::uint8_t> PackedEncoder::encode(const Frames& frames) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(16 * frames.frames.size());
  encode(frames, bytes);
  return bytes;
}

void PackedEncoder::encode(const Frames& frames, std::vector<std::uint8_t>& to) {
  assert(frames.sequence == 0 || frames.sequence == state_.sequence + 1);
  assert(!frames.frames.empty() && frames.frames.size() <= max_frames_per_message);
  assert(frames.media_time <= max_media_time);
  to.push_back(static_cast<std::uint8_t>(MessageTraits<Frames>::type | ((state_.sequence + 1) & 0x7FU)));
  RangeEncoder coder(to);
  ModelCoder<RangeEncoder> model_coder(coder);
  PackedModel model(model_coder, *table_, state_);
  model.count(frames.frames.size());
  model.base_time(frames.media_time);
  model.offset(frames.frames.front().time);
  std::uint32_t time = frames.frames.front().time;
  for (const TimedFrame& frame : frames.frames) {
    assert(is_valid(frame.state) && frame.time >= time && frame.time <= max_frame_time);
    if (&frame != &frames.frames.front()) model.step(frame.time - time);
    time = frame.time;
    FaceFrame now = frame.state;
    model.frame(now);
  }
  coder.finish();
  state_.sequence += frames.frames.size();
  state_.fresh = false;
}

std::vector<std::uint8_t> PackedEncoder::keyframe() const {
  std::vector<std::uint8_t> bytes = {MessageTraits<Keyframe>::type};
  byte_io::append_varint(bytes, state_.sequence);
  byte_io::append_varint(bytes, state_.media_time);
  RangeEncoder coder(bytes);
  PackedState initial;
  ModelCoder<RangeEncoder> model_coder(coder);
  PackedModel model(model_coder, *table_, initial);
  model.history(state_);
  coder.finish();
  return bytes;
}

}  // namespace semblante

#include "server/recordings/recording_version_1.h"

#include <algorithm>

#include "core/tables/mpeg4.h"
#include "protocol/cpp/byte_io.h"

namespace semblante::recordings {
namespace {

constexpr std::uint8_t keyframe_type = 3, frames_type = 4;
constexpr std::uint32_t viseme_bit = 1U << 0U, expression_bit = 1U << 1U;
constexpr std::uint64_t known_bits = (1U << 11U) - 1U;  // viseme, expression, FAP groups 2..10 by number
constexpr std::int64_t level_limit = static_cast<std::int64_t>(max_level);

Error malformed(const char* message) { return {ErrorCode::malformed, "", message}; }

constexpr std::int64_t unzigzag(std::uint64_t value) {
  return static_cast<std::int64_t>(value >> 1U) ^ -static_cast<std::int64_t>(value & 1U);
}

/// The differences of a group's FAPs; false for a mask without a bit or with bits beyond the group, and for a level
/// out of range.
bool read_group(byte_io::Reader& reader, const mpeg4::FapGroup& group, FaceFrame& state) {
  const std::uint64_t mask = reader.varint();
  const unsigned size = group.last_fap - group.first_fap + 1U;
  if (mask == 0 || mask >> size != 0) return false;
  for (unsigned i = 0; i < size; ++i) {
    if ((mask >> i & 1U) == 0) continue;
    const std::size_t fap = group.first_fap + i;
    const std::uint64_t difference = reader.varint();
    if (difference >> 17U != 0) return false;  // two levels within the limits are nearer to each other
    const std::int64_t level = state.level[fap] + unzigzag(difference);
    if (level < -level_limit || level > level_limit) return false;
    state.level[fap] = static_cast<std::int16_t>(level);
  }
  return true;
}

/// Replaces `state` by the one that these differences lead to.
Status read_state(byte_io::Reader& reader, FaceFrame& state) {
  const std::uint64_t bits = reader.varint();
  if ((bits & ~known_bits) != 0) return malformed("a state has unknown bits");
  if ((bits & viseme_bit) != 0) state.viseme = {reader.u8(), reader.u8(), reader.u8()};
  if ((bits & expression_bit) != 0) state.expression = {reader.u8(), reader.u8(), reader.u8(), reader.u8()};
  for (const auto& group : mpeg4::fap_groups) {
    if (group.number == 1 || (bits >> group.number & 1U) == 0) continue;
    if (!read_group(reader, group, state) && !reader.failed()) return malformed("a state has values out of range");
  }
  if (reader.failed()) return Error{ErrorCode::truncated, "", "the message ends within a state"};
  if (!is_valid(state)) return malformed("a state has values out of range");
  return Unit{};
}

}  // namespace

bool Version1Decoder::reads(std::uint8_t type) { return type == keyframe_type; }

Result<Keyframe> Version1Decoder::keyframe(std::span<const std::uint8_t> message) {
  byte_io::Reader reader(message);
  Keyframe keyframe;
  if (reader.u8() != keyframe_type) return malformed("a chunk must begin with a keyframe");
  keyframe.sequence = reader.varint();
  keyframe.media_time = reader.varint();
  if (auto status = read_state(reader, keyframe.state); !status) return std::move(status).error();
  last_ = keyframe.state;
  return keyframe;
}

Status Version1Decoder::frames(std::span<const std::uint8_t> message, Frames& to) {
  byte_io::Reader reader(message);
  if (reader.u8() != frames_type) return malformed("after the keyframe of a chunk there must be frames");
  to.sequence = reader.varint();
  to.media_time = reader.varint();
  const std::uint64_t count = reader.varint();
  // A frame has at least two bytes, so this bounds the declared count by the remaining bytes.
  if (reader.failed() || count == 0 || count > std::min(max_frames_per_message, reader.remaining() / 2))
    return malformed("the number of frames is impossible");
  to.frames.clear();
  std::uint64_t time = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t later = reader.varint();
    if (later > max_frame_time - time) return malformed("a frame is more than a day after its message");
    time += later;
    if (auto status = read_state(reader, last_); !status) return status;
    to.frames.push_back({static_cast<std::uint32_t>(time), last_});
  }
  return Unit{};
}

}  // namespace semblante::recordings

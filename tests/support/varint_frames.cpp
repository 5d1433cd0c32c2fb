#include "tests/support/varint_frames.h"

#include "core/tables/mpeg4.h"
#include "protocol/cpp/byte_io.h"

namespace semblante::testing {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t zigzag(std::int32_t value) {
  return (static_cast<std::uint32_t>(value) << 1U) ^ (value < 0 ? ~0U : 0U);
}

/// Mask of the FAPs of a group that differ; bit 0 is the first FAP of the group.
std::uint32_t changes(const mpeg4::FapGroup& group, const FaceFrame& from, const FaceFrame& state) {
  std::uint32_t mask = 0;
  for (std::size_t fap = group.first_fap; fap <= group.last_fap; ++fap) {
    if (from.level[fap] != state.level[fap]) mask |= 1U << (fap - group.first_fap);
  }
  return group.number == 1 ? 0 : mask;
}

void append_state(Bytes& to, const FaceFrame& from, const FaceFrame& state) {
  const auto& [viseme, expression, level] = state;
  const bool has_viseme = from.viseme != viseme;
  const bool has_expression = from.expression != expression;
  std::uint32_t bits = (has_viseme ? 1U : 0U) | (has_expression ? 2U : 0U);
  for (const auto& group : mpeg4::fap_groups) {
    if (changes(group, from, state) != 0) bits |= 1U << group.number;
  }
  byte_io::append_varint(to, bits);
  if (has_viseme) to.insert(to.end(), {viseme.select1, viseme.select2, viseme.blend});
  if (has_expression)
    to.insert(to.end(), {expression.select1, expression.intensity1, expression.select2, expression.intensity2});
  for (const auto& group : mpeg4::fap_groups) {
    const std::uint32_t mask = changes(group, from, state);
    if (mask == 0) continue;
    byte_io::append_varint(to, mask);
    for (std::size_t fap = group.first_fap; fap <= group.last_fap; ++fap) {
      if ((mask >> (fap - group.first_fap) & 1U) != 0) byte_io::append_varint(to, zigzag(level[fap] - from.level[fap]));
    }
  }
}

}  // namespace

Bytes varint_keyframe(const Keyframe& keyframe) {
  Bytes bytes = {3};
  byte_io::append_varint(bytes, keyframe.sequence);
  byte_io::append_varint(bytes, keyframe.media_time);
  append_state(bytes, FaceFrame{}, keyframe.state);
  return bytes;
}

Bytes varint_frames(const Frames& frames, const FaceFrame& before) {
  Bytes bytes = {4};
  byte_io::append_varint(bytes, frames.sequence);
  byte_io::append_varint(bytes, frames.media_time);
  byte_io::append_varint(bytes, frames.frames.size());
  const FaceFrame* last = &before;
  std::uint32_t time = 0;
  for (const TimedFrame& frame : frames.frames) {
    byte_io::append_varint(bytes, frame.time - time);
    append_state(bytes, *last, frame.state);
    last = &frame.state;
    time = frame.time;
  }
  return bytes;
}

}  // namespace semblante::testing

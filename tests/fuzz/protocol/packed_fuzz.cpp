// A connection of packed messages: each input is a run of (length byte, message). What is accepted is said again from
// the same state, and must mean the same.
#include <algorithm>
#include <cstdlib>

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/packed_codec.h"
#include "protocol/cpp/state_codec.h"

using namespace semblante;

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FrameDecoder decoder;
  FrameDecoder again;
  PackedEncoder encoder;
  for (std::size_t at = 0; at < size;) {
    const std::size_t length = std::min<std::size_t>(data[at], size - at - 1);
    const auto message = decoder.decode({data + at + 1, length});
    at += 1 + length;
    if (!message) continue;
    if (const auto* keyframe = std::get_if<Keyframe>(&*message)) {
      encoder = PackedEncoder(*keyframe);
      const auto echo = again.decode(encoder.keyframe());
      require(echo && *echo == *message);
    } else if (const auto* frames = std::get_if<Frames>(&*message)) {
      for (const TimedFrame& frame : frames->frames) require(is_valid(frame.state));
      const auto echo = again.decode(encoder.encode(*frames));
      require(echo && *echo == *message);
      // Who joins here reads on, too.
      FrameDecoder late;
      require(late.decode(encoder.keyframe()).ok());
    }
  }
  return 0;
}

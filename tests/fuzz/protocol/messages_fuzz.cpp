// A connection of binary messages: each input is a run of (length byte, message).
#include <algorithm>
#include <cstdlib>

#include "protocol/cpp/frame_codec.h"

using namespace semblante;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FrameDecoder decoder;
  FrameDecoder again;
  FrameEncoder encoder;
  for (std::size_t at = 0; at < size;) {
    const std::size_t length = std::min<std::size_t>(data[at], size - at - 1);
    const auto message = decoder.decode({data + at + 1, length});
    at += 1 + length;
    if (!message) continue;
    // What was accepted can be said again, and means the same.
    const auto echo = again.decode(encoder.encode(*message));
    if (!echo || !(*echo == *message)) std::abort();
  }
  return 0;
}

// A connection of binary messages: each input is a run of (length byte, message). What is accepted is said again, and
// must mean the same; who joins at any frame reads on. A client reads the same, but for what only clients send.
#include <algorithm>
#include <cstdlib>

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/packed_codec.h"
#include "protocol/cpp/packed_text.h"

using namespace semblante;

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

std::vector<std::uint8_t> said_again(const Message& message, PackedEncoder& encoder) {
  if (const auto* keyframe = std::get_if<Keyframe>(&message)) {
    encoder = PackedEncoder(*keyframe);
    return encoder.keyframe();
  }
  if (const auto* frames = std::get_if<Frames>(&message)) {
    for (const TimedFrame& frame : frames->frames) require(is_valid(frame.state));
    return encoder.encode(*frames);
  }
  std::vector<std::uint8_t> bytes;
  encode_message(message, bytes);
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FrameDecoder decoder, client;
  FrameDecoder again;
  PackedEncoder encoder;
  for (std::size_t at = 0; at < size;) {
    const std::size_t length = std::min<std::size_t>(data[at], size - at - 1);
    const auto message = decoder.decode({data + at + 1, length});
    // Servers refuse packed texts, which only clients read; fuzz_protocol_packed_text reads them.
    if (length > 0 && data[at + 1] == packed_text_type) {
      require(!message);
      at += 1 + length;
      continue;
    }
    const auto seen = client.decode_from_server({data + at + 1, length});
    const auto unknown = !seen && seen.error().code == ErrorCode::unsupported && seen.error().where == "/type";
    require(unknown || (seen.ok() == message.ok() && (!seen || *seen == *message)));
    require(!unknown || !message || std::holds_alternative<Hello>(*message) ||
            std::holds_alternative<Spoken>(*message) || std::holds_alternative<CaptionsWish>(*message) ||
            std::holds_alternative<Ping>(*message));
    at += 1 + length;
    if (!message) continue;
    const auto echo = again.decode(said_again(*message, encoder));
    require(echo && *echo == *message);
    FrameDecoder late;
    require(late.decode(encoder.keyframe()).ok());
  }
  return 0;
}

#include "server/streams/encoding.h"

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/json_codec.h"
#include "protocol/cpp/packed_text.h"
#include "server/http/wire_message.h"

namespace semblante::streams {

void append_payload(std::string& wire, const std::vector<std::uint8_t>& payload) {
  http::append_message(wire, {reinterpret_cast<const char*>(payload.data()), payload.size()}, true);
}

void append_encoded(std::string& wire, const Message& message, bool binary, const QuantizerSteps& steps) {
  if (!binary) return http::append_message(wire, encode_json(message, steps), false);
  std::vector<std::uint8_t> payload;
  if (const auto* text = std::get_if<SpeechText>(&message))
    write_packed_text(*text, payload);
  else
    encode_message(message, payload);
  append_payload(wire, payload);
}

void append_join_point(std::string& wire, const PackedEncoder& packed, Coding coding, const QuantizerSteps& steps) {
  if (coding == Coding::packed)
    append_payload(wire, packed.keyframe());
  else
    append_encoded(wire, Keyframe{packed.sequence(), packed.media_time(), packed.state()}, false, steps);
}

}  // namespace semblante::streams

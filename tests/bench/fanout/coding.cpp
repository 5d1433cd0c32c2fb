#include "tests/bench/fanout/coding.h"

#include "protocol/cpp/json_codec.h"
#include "tests/bench/fanout/websocket_wire.h"
#include "tests/support/frame_encoder.h"

namespace semblante::bench {

std::string_view subprotocol_of(Coding coding) {
  return coding == Coding::json ? json_subprotocol : binary_subprotocol;
}

std::string hello_frame(Coding coding) {
  const Hello hello;
  if (coding == Coding::json) return client_frame(Opcode::text, encode_json(hello));
  const auto bytes = FrameEncoder().encode(hello);
  return client_frame(Opcode::binary, std::string(bytes.begin(), bytes.end()));
}

}  // namespace semblante::bench

#include "tests/bench/fanout/websocket_wire.h"

namespace semblante::bench {
namespace {

constexpr char mask[4] = {0x5e, 0x3b, 0x1a, 0x7f};
constexpr std::uint64_t most_payload = std::uint64_t{16} << 20U;

}  // namespace

std::string upgrade_request(std::string_view authority, std::string_view path, std::string_view subprotocol) {
  std::string text("GET ");
  text.append(path).append(" HTTP/1.1\r\nHost: ").append(authority);
  text.append("\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: ");
  text.append(sample_key).append("\r\n");
  if (!subprotocol.empty()) text.append("Sec-WebSocket-Protocol: ").append(subprotocol).append("\r\n");
  return text.append("\r\n");
}

std::string client_frame(Opcode opcode, std::string_view payload) {
  std::string bytes;
  bytes.push_back(static_cast<char>(0x80U | static_cast<unsigned>(opcode)));
  const auto put = [&](unsigned marker, unsigned count) {
    bytes.push_back(static_cast<char>(0x80U | marker));
    for (unsigned i = count; i-- > 0;) bytes.push_back(static_cast<char>(payload.size() >> (8U * i)));
  };
  if (payload.size() < 126)
    bytes.push_back(static_cast<char>(0x80U | payload.size()));
  else if (payload.size() < 65536)
    put(126, 2);
  else
    put(127, 8);
  bytes.append(mask, sizeof mask);
  for (std::size_t i = 0; i < payload.size(); ++i) bytes.push_back(static_cast<char>(payload[i] ^ mask[i % 4]));
  return bytes;
}

HeadState read_head(std::string_view bytes, FrameHead& head) {
  if (bytes.size() < 2) return HeadState::incomplete;
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  if ((byte(0) & 0xf0U) != 0x80U || (byte(1) & 0x80U) != 0) return HeadState::wrong;
  head.opcode = static_cast<Opcode>(byte(0) & 0x0fU);
  const unsigned marker = byte(1);
  const std::size_t extra = marker == 127 ? 8 : marker == 126 ? 2 : 0;
  head.head_bytes = 2 + extra;
  if (bytes.size() < head.head_bytes) return HeadState::incomplete;
  std::uint64_t length = extra == 0 ? marker : 0;
  for (std::size_t i = 0; i < extra; ++i) length = length << 8U | byte(2 + i);
  if (length > most_payload) return HeadState::wrong;
  head.payload_bytes = static_cast<std::size_t>(length);
  return HeadState::complete;
}

int close_code(std::string_view payload) {
  if (payload.size() < 2) return 1005;
  return static_cast<std::uint8_t>(payload[0]) << 8U | static_cast<std::uint8_t>(payload[1]);
}

}  // namespace semblante::bench

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace semblante::bench {

// The client's side of RFC 6455, as far as a load generator needs it.

enum class Opcode : std::uint8_t { text = 1, binary = 2, close = 8, ping = 9, pong = 10 };

/// Every client says the RFC's sample key, so that a baseline may answer with the constant below.
inline constexpr std::string_view sample_key = "dGhlIHNhbXBsZSBub25jZQ==";
inline constexpr std::string_view sample_accept = "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=";

std::string upgrade_request(std::string_view authority, std::string_view path, std::string_view subprotocol);

/// One whole message of a client, masked.
std::string client_frame(Opcode opcode, std::string_view payload);

struct FrameHead {
  Opcode opcode = Opcode::binary;
  std::size_t head_bytes = 0, payload_bytes = 0;
};
enum class HeadState { incomplete, wrong, complete };
/// The head of a server's frame. Wrong: masked, fragmented, with reserved bits, or over 16 MiB, none of which is sent
/// here.
HeadState read_head(std::string_view bytes, FrameHead& head);

/// Code of a close frame's payload; 1005 when it has none.
int close_code(std::string_view payload);

}  // namespace semblante::bench

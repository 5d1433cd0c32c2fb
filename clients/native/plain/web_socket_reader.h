#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/types/result.h"

namespace semblante::client {

/// The kinds of frames of a WebSocket (RFC 6455, section 5.2).
enum class WebSocketKind : std::uint8_t { continuation = 0, text = 1, binary = 2, close = 8, ping = 9, pong = 10 };

/// Reads what a server sends over a WebSocket, from pieces of any size. Whether a text is UTF-8 is left to its reader.
class WebSocketReader {
 public:
  struct Message {
    WebSocketKind kind;
    std::span<const std::uint8_t> bytes;
  };

  /// `most`: bytes of a message.
  explicit WebSocketReader(std::size_t most) : most_(most) {}

  void take(std::span<const std::uint8_t> bytes);
  /// The next whole message or control frame, valid until the next call of either function; nullopt if more bytes are
  /// needed. Errors: malformed, too_large, known before the bytes of the message are there.
  Result<std::optional<Message>> next();

 private:
  std::size_t most_;
  std::vector<std::uint8_t> held_;
  std::size_t at_ = 0;  ///< the first byte of `held_` that was not read
  std::vector<std::uint8_t> message_;
  WebSocketKind kind_ = WebSocketKind::continuation;  ///< of the message whose fragments are read; else continuation
};

/// A frame of a client, with its bytes masked by `mask`; sent whole.
std::vector<std::uint8_t> web_socket_frame(WebSocketKind kind, std::span<const std::uint8_t> bytes, std::uint32_t mask);

}  // namespace semblante::client

#pragma once

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "clients/native/client/stream_socket.h"
#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/messages.h"
#include "tests/support/frame_encoder.h"

namespace semblante::testing {

/// One connection that says and hears single messages of the protocol, for tests that want to be the client
/// themselves: no pings, no resume.
class StreamSpeaker {
 public:
  /// Connects and says `hello`. Errors: those of StreamSocket.
  static Result<StreamSpeaker> connect(const client::ServerAddress& server, std::string_view stream,
                                       const Hello& hello = {},
                                       std::chrono::milliseconds timeout = std::chrono::seconds(10)) {
    auto socket = client::StreamSocket::open(server, stream, {.timeout = timeout});
    if (!socket) return std::move(socket).error();
    StreamSpeaker speaker(*std::move(socket));
    if (auto said = speaker.send(hello); !said) return std::move(said).error();
    return speaker;
  }

  /// The next message of the server; nullopt at the timeout. Errors: io when the connection is closed, else the error
  /// of the message.
  Result<std::optional<Message>> next(std::chrono::milliseconds timeout) {
    auto bytes = socket_.read(timeout);
    if (!bytes) return std::move(bytes).error();
    if (!*bytes) return std::optional<Message>();
    auto message = decoder_.decode(**bytes);
    if (!message) return std::move(message).error();
    return std::optional<Message>(*std::move(message));
  }

  Status send(const Message& message) { return socket_.send(encoder_.encode(message)); }

 private:
  explicit StreamSpeaker(client::StreamSocket socket) : socket_(std::move(socket)) {}

  client::StreamSocket socket_;
  FrameEncoder encoder_;
  FrameDecoder decoder_;
};

}  // namespace semblante::testing

#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/types/result.h"
#include "protocol/http/server_address.h"

namespace semblante::client {

struct SocketOptions {
  bool json = false;                          ///< the subprotocol to write and read by hand, instead of the binary one
  std::chrono::milliseconds timeout{10'000};  ///< of connecting and of one send
};

/// One WebSocket to /v1/streams/{id}, which moves bytes. Blocking, for one thread. Does not trust the server: message
/// sizes are bounded before they are read.
class StreamSocket {
 public:
  /// Errors: io, missing (no such stream), invalid_argument (the token is not accepted), mismatch (the server uses
  /// another subprotocol).
  static Result<StreamSocket> open(const ServerAddress& server, std::string_view stream,
                                   const SocketOptions& options = {});
  ~StreamSocket();
  StreamSocket(StreamSocket&&) noexcept;
  StreamSocket& operator=(StreamSocket&&) noexcept;

  /// The bytes of the next message, valid until the next call; nullopt at the timeout. Errors: io when the connection
  /// is closed (see close_code), too_large.
  Result<std::optional<std::span<const std::uint8_t>>> read(std::chrono::milliseconds timeout);

  /// Sends one message, as a text in JSON's subprotocol. Errors: io.
  Status send(std::span<const std::uint8_t> bytes);

  /// Closes with a handshake; waits at most the connection's timeout for the server.
  void close();
  /// The server's close code; 0 before, and when the connection was lost.
  [[nodiscard]] std::uint16_t close_code() const;
  [[nodiscard]] std::string close_reason() const;

 private:
  struct Impl;
  explicit StreamSocket(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace semblante::client

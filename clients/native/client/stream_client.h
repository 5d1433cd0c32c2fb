#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"
#include "protocol/http/server_address.h"

namespace semblante::client {

struct StreamOptions {
  bool json = false;  ///< the subprotocol to write and read by hand, instead of the binary one
  StreamRole role = StreamRole::subscribe;
  StreamCoding coding = StreamCoding::packed;  ///< requested; JSON is always plain
  std::optional<ResumePoint> resume;
  bool take_over = false;                     ///< of a publisher: replaces the current source
  std::chrono::milliseconds timeout{10'000};  ///< of connecting and of one send
};

/// One WebSocket to /v1/streams/{id}. Blocking, for one thread. Does not trust the server: message sizes are bounded
/// before they are read.
class StreamClient {
 public:
  /// Connects without a word: for `read` and `send_raw`. Errors like `connect`.
  static Result<StreamClient> open(const ServerAddress& server, std::string_view stream,
                                   const StreamOptions& options = {});
  /// Connects and sends a hello. Errors: io, missing (no such stream),
  /// invalid_argument (the token is not accepted), mismatch (the server uses another subprotocol).
  static Result<StreamClient> connect(const ServerAddress& server, std::string_view stream,
                                      const StreamOptions& options = {});
  ~StreamClient();
  StreamClient(StreamClient&&) noexcept;
  StreamClient& operator=(StreamClient&&) noexcept;

  /// The next message of the server; nullopt at the timeout. Messages of a later version are skipped. Errors: io when
  /// the connection is closed (see close_code), else the error of the message.
  Result<std::optional<Message>> next(std::chrono::milliseconds timeout);

  /// The bytes of the next message, valid until the next call; nullopt at the timeout. Errors: io when the connection
  /// is closed (see close_code), too_large.
  Result<std::optional<std::span<const std::uint8_t>>> read(std::chrono::milliseconds timeout);

  /// Sends in the subprotocol in use. Frames must follow a keyframe of the same client. Errors: io.
  Status send(const Message& message);
  /// Sends any bytes.
  Status send_raw(std::string_view bytes, bool as_text);

  /// Closes with a handshake; waits at most the connection's timeout for the server.
  void close();
  /// The server's close code; 0 before, and when the connection was lost.
  [[nodiscard]] std::uint16_t close_code() const;
  [[nodiscard]] std::string close_reason() const;

 private:
  struct Impl;
  explicit StreamClient(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace semblante::client

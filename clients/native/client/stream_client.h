#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"
#include "protocol/http/url.h"

namespace semblante::client {

struct StreamOptions {
  bool json = false;  ///< the subprotocol to write and read by hand, instead of the binary one
  StreamRole role = StreamRole::subscribe;
  StreamCoding coding = StreamCoding::packed;  ///< asked for; JSON is plain whatever this says
  std::optional<ResumePoint> resume;
  bool take_over = false;                     ///< of a publisher: to replace the one there is
  std::chrono::milliseconds timeout{10'000};  ///< of connecting and of one send
};

/// One WebSocket to /v1/streams/{id}. Blocking, for one thread. Trusts nothing a server sends: message sizes are
/// bounded before they are read.
class StreamClient {
 public:
  /// Connects and says hello. Errors: io, missing (no such stream), mismatch (the server speaks another subprotocol).
  static Result<StreamClient> connect(const Url& url, std::string_view stream, const StreamOptions& options = {});
  ~StreamClient();
  StreamClient(StreamClient&&) noexcept;
  StreamClient& operator=(StreamClient&&) noexcept;

  /// The next message the server sends; nullopt when none came in time. Messages of a later version are skipped.
  /// Errors: io when the connection is closed (close_code says how), else what was wrong with the message.
  Result<std::optional<Message>> next(std::chrono::milliseconds timeout);

  /// When the hello went out: its header answers it.
  [[nodiscard]] std::chrono::steady_clock::time_point hello_sent() const;

  /// Sends in the subprotocol in use. Frames must follow a keyframe of the same client. Errors: io.
  Status send(const Message& message);
  /// Sends anything at all, as a peer that does not keep to the protocol would.
  Status send_raw(std::string_view bytes, bool as_text);

  /// Closes politely; waits at most the connection's timeout for the other side.
  void close();
  /// What the server gave as reason, once closed; 0 before, and when the connection just broke.
  [[nodiscard]] std::uint16_t close_code() const;
  [[nodiscard]] std::string close_reason() const;

 private:
  struct Impl;
  explicit StreamClient(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace semblante::client

#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <random>
#include <string>

#include "clients/native/client/stream_socket.h"
#include "clients/runtime/stream.h"
#include "core/types/result.h"
#include "protocol/cpp/messages.h"
#include "protocol/http/server_address.h"

namespace semblante::client {

struct LiveStreamOptions {
  SocketOptions socket;
  StreamRole role = StreamRole::subscribe;
  std::optional<ResumePoint> resume;  ///< of the first connection
  bool take_over = false;             ///< of a publisher: replaces the current source
  /// First and longest pause before reconnecting. Each attempt doubles the pause; half of it is random.
  std::chrono::milliseconds first_pause{250}, longest_pause{10'000};
  /// A connection is lost when the server answers nothing for this long.
  std::chrono::milliseconds silence_limit{20'000};
  std::uint64_t seed = std::random_device{}();
};

/// A stream across connections: carries bytes between a socket and a `runtime::Stream`, which reconnects after a loss,
/// resumes where it stopped, and measures the stream's clock. For one thread, which should be in next() as much as
/// possible: messages received otherwise get late timestamps.
class LiveStream {
 public:
  using Clock = std::chrono::steady_clock;

  LiveStream(ServerAddress server, std::string stream, LiveStreamOptions options = {});

  /// The next event of machine(), whose frames are those of machine().newest() until the next call; of type NONE at the
  /// timeout. The connection is made, closed and made again here. Errors: missing (no such stream), mismatch (another
  /// subprotocol), invalid_argument (the token), for which reconnecting does not help. Nothing follows the stream's
  /// final end.
  Result<runtime::Event> next(std::chrono::milliseconds timeout);
  /// Closes the connection; next() opens no other.
  void close();
  /// The current time of the clock of all timestamps, ms; its origin is arbitrary.
  static double now();

  /// The state of the stream, for players to follow and to publish by: next() sends what it has to send.
  runtime::Stream& machine() { return machine_; }
  [[nodiscard]] bool connected() const { return machine_.state() == SEMBLANTE_STREAM_OPEN; }
  /// The stream has ended for good, or was closed: next() opens no further connection.
  [[nodiscard]] bool ended() const { return machine_.state() == SEMBLANTE_STREAM_CLOSED; }
  [[nodiscard]] const std::optional<Header>& header() const { return machine_.header(); }
  /// The resume point for the next hello.
  [[nodiscard]] const std::optional<ResumePoint>& resume() const { return machine_.resume(); }
  /// The resume point that the last hello sent.
  [[nodiscard]] const std::optional<ResumePoint>& sent_resume() const { return machine_.sent_resume(); }
  [[nodiscard]] std::uint64_t connections() const { return connections_; }
  /// Why there is no connection; none while there is one.
  [[nodiscard]] const std::optional<Error>& loss() const { return loss_; }

 private:
  Status connect();
  /// Does what the machine asks for, up to its next event for the caller.
  Result<runtime::Event> obey();
  void lose(Error why);
  /// Reads a message until `until`.
  void receive(Clock::time_point until);

  ServerAddress server_;
  std::string stream_;
  SocketOptions options_;
  runtime::Stream machine_;
  std::optional<StreamSocket> socket_;
  std::optional<Error> loss_;
  std::uint64_t connections_ = 0;
};

}  // namespace semblante::client

#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <random>
#include <string>

#include "clients/native/client/stream_client.h"
#include "clients/runtime/stream.h"
#include "core/types/result.h"
#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/messages.h"
#include "protocol/http/server_address.h"

namespace semblante::client {

struct LiveStreamOptions {
  /// Options of every connection; `resume` applies to the first connection only.
  StreamOptions stream;
  /// First and longest pause before reconnecting. Each attempt doubles the pause; half of it is random.
  std::chrono::milliseconds first_pause{250}, longest_pause{10'000};
  std::uint64_t seed = std::random_device{}();
};

/// A subscription across connections: carries bytes between a socket and a `runtime::Stream`, which reconnects after a
/// loss, resumes where it stopped, and measures the stream's clock. For one thread, which should be in next() as much
/// as possible: messages received otherwise get late timestamps.
class LiveStream {
 public:
  using Clock = std::chrono::steady_clock;

  LiveStream(ServerAddress server, std::string stream, LiveStreamOptions options = {});

  /// The next message; nullopt at the timeout, and without a connection. Errors: missing (no such stream), mismatch
  /// (another subprotocol), invalid_argument (the token), for which reconnecting does not help. No messages follow the
  /// stream's final `end`.
  Result<std::optional<Message>> next(std::chrono::milliseconds timeout);
  /// Closes the connection; next() opens no other.
  void close();
  /// The current time of the clock of all timestamps, ms; its origin is arbitrary.
  static double now();

  /// The state of the stream, for players to follow.
  runtime::Stream& machine() { return machine_; }
  [[nodiscard]] bool connected() const { return machine_.state() == SEMBLANTE_STREAM_OPEN; }
  [[nodiscard]] const std::optional<Header>& header() const { return machine_.header(); }
  /// The resume point for the next hello.
  [[nodiscard]] const std::optional<ResumePoint>& resume() const { return machine_.resume(); }
  /// The resume point that the last hello sent.
  [[nodiscard]] const std::optional<ResumePoint>& sent_resume() const { return machine_.sent_resume(); }
  [[nodiscard]] std::uint64_t connections() const { return connections_; }

 private:
  Status connect();
  /// Does what the machine asks for.
  Status obey();
  /// Reads a message until `until`.
  std::optional<Message> receive(Clock::time_point until);

  ServerAddress server_;
  std::string stream_;
  StreamOptions options_;
  runtime::Stream machine_;
  FrameDecoder decoder_;
  std::optional<StreamClient> client_;
  std::uint64_t connections_ = 0;
};

}  // namespace semblante::client

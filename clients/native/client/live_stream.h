#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <random>
#include <string>

#include "clients/native/client/clock_estimate.h"
#include "clients/native/client/stream_client.h"
#include "core/types/result.h"
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

/// A subscription across connections: reconnects after a loss, resumes where it stopped, and measures the stream's
/// clock continuously. For one thread, which should be in next() as much as possible: messages received otherwise get
/// late timestamps.
class LiveStream {
 public:
  using Clock = std::chrono::steady_clock;

  LiveStream(ServerAddress server, std::string stream, LiveStreamOptions options = {});

  /// The next message; nullopt at the timeout, and without a connection. Errors: missing (no such stream), mismatch
  /// (another subprotocol), invalid_argument (the token), for which reconnecting does not help. No messages follow the
  /// stream's final `end`.
  Result<std::optional<Message>> next(std::chrono::milliseconds timeout);
  /// The estimate of the stream's clock relative to now().
  ClockEstimate& clock() { return clock_; }
  /// The current time of the clock of all timestamps, ms; its origin is arbitrary.
  static double now();

  [[nodiscard]] bool connected() const { return client_.has_value() && greeted_; }
  [[nodiscard]] const std::optional<Header>& header() const { return header_; }
  /// The resume point for the next hello.
  [[nodiscard]] const std::optional<ResumePoint>& resume() const { return resume_; }
  /// The resume point that the last hello sent.
  [[nodiscard]] const std::optional<ResumePoint>& sent_resume() const { return sent_resume_; }
  [[nodiscard]] std::uint64_t connections() const { return connections_; }

 private:
  Status connect();
  void lose();
  void take(const Message& message, double received);
  /// Sends a ping when one is due.
  void ping();

  ServerAddress server_;
  std::string stream_;
  LiveStreamOptions options_;
  std::mt19937_64 random_;
  std::optional<StreamClient> client_;
  std::optional<Header> header_;
  std::optional<ResumePoint> resume_, sent_resume_;
  ClockEstimate clock_;
  Clock::time_point next_try_{}, next_ping_{};
  std::uint64_t tries_ = 0, connections_ = 0;
  std::size_t pings_ = 0;
  std::uint32_t ping_id_ = 0;
  bool greeted_ = false, over_ = false;
};

}  // namespace semblante::client

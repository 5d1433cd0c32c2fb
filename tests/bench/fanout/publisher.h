#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>

#include "tests/bench/fanout/content.h"
#include "tests/bench/fanout/loopback.h"

namespace semblante::bench {

/// How a stream is fed.
struct Feed {
  double messages_per_second = 25.0;
  std::size_t frames_per_message = 1;
  bool heavy = false;
};

/// One connection that publishes the bench's trace, frame 1 first, on a thread of its own until it is destroyed.
class Publisher {
 public:
  /// Waits until the server has let it publish. `sent` gets the moment of each frame and outlives this.
  Publisher(const Endpoint& endpoint, const std::string& path, const Feed& feed, SendTimes& sent);
  ~Publisher();
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;

  /// Errors that the server answered.
  [[nodiscard]] std::uint64_t errors() const { return errors_; }
  /// Of these, how many said `throttled`.
  [[nodiscard]] std::uint64_t throttled() const { return throttled_; }
  /// The server ended the connection.
  [[nodiscard]] bool lost() const { return lost_; }
  [[nodiscard]] std::uint64_t frames_sent() const { return frames_sent_; }

 private:
  void run();
  void listen();

  Socket socket_;
  const Feed feed_;
  SendTimes& sent_;
  std::string received_;
  std::atomic<bool> stop_{false}, lost_{false};
  std::atomic<std::uint64_t> errors_{0}, throttled_{0}, frames_sent_{0};
  std::thread thread_;
};

/// For a reader that is slow: the kernel holds little for it, and it falls behind within seconds.
inline constexpr int small_receive_buffer = 4096;

/// A connection with its handshake done, for one that publishes or one that misbehaves.
Socket open_websocket(const Endpoint& endpoint, const std::string& path, std::string_view subprotocol,
                      int receive_buffer = 0);

}  // namespace semblante::bench

#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "clients/native/client/stream_socket.h"
#include "clients/runtime/stream.h"
#include "core/kernel/semblante_kernel.h"
#include "core/types/result.h"

namespace semblante::client {

struct PublisherOptions {
  bool create = false;                         ///< create the stream if it does not exist
  std::string model;                           ///< the model of the created stream; may be empty
  bool take_over = false;                      ///< replace another publisher
  std::chrono::milliseconds timeout{3000};     ///< for connecting, and for sending one message
  std::chrono::milliseconds retry_first{250};  ///< after a loss; doubled with each failure
  std::chrono::milliseconds retry_most{5000};
};

/// A publisher: carries bytes between a socket and a `runtime::Stream`, which reconnects when the connection is lost
/// and continues with a keyframe. For one thread; all work is done within its calls.
class StreamPublisher {
 public:
  StreamPublisher(ServerAddress server, std::string stream, PublisherOptions options = {});

  /// Connects when there is no connection and a retry is due; else reads messages of the server for about a
  /// millisecond. Call it at least a few times per second. Errors: missing (no such stream, and `create` is not set),
  /// invalid_argument (the token is not accepted) and the server's error on creating one; other errors are retried.
  Status look_after();

  [[nodiscard]] bool connected() const { return socket_ && machine_.state() == SEMBLANTE_STREAM_OPEN; }
  /// Sends the state of the face. `media_time`: ms of a monotonic clock of the caller, more than 0; the server keeps
  /// its spacing. The FAPs must be finite. False when there is no connection: the frame is lost.
  bool publish(const semblante_frame& frame, std::uint64_t media_time);

  /// Events of the connection since the last call, as text for display.
  std::optional<std::string> take_news();
  /// Closes the connection.
  void close();

 private:
  using Clock = std::chrono::steady_clock;
  static double now();
  Status connect();
  Status make_stream();
  /// Does what the machine asks for.
  Status obey();
  void listen(std::chrono::milliseconds patience);
  void lose(const std::string& why);
  /// News, unless they are those of before.
  void trouble(const std::string& what, const std::string& why);

  ServerAddress server_;
  std::string stream_;
  PublisherOptions options_;
  std::optional<StreamSocket> socket_;
  runtime::Stream machine_;
  /// When to go on after an end for good: the stream may be there again, or free.
  std::optional<double> start_at_;
  std::optional<std::string> news_;
  std::string last_trouble_;
};

}  // namespace semblante::client

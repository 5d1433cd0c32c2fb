#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "clients/native/client/stream_client.h"
#include "core/kernel/semblante_kernel.h"
#include "core/types/result.h"
#include "protocol/cpp/quantizers.h"

namespace semblante::client {

struct PublisherOptions {
  bool create = false;  ///< make the stream where there is none
  std::string model;    ///< what a stream made so suggests; may be empty
  bool take_over = false;
  std::chrono::milliseconds timeout{3000};     ///< of connecting, and of one send
  std::chrono::milliseconds retry_first{250};  ///< after a loss; doubled with each failure
  std::chrono::milliseconds retry_most{5000};
};

/// A publisher that stays: it connects, connects again when the connection is lost, and then goes on with a keyframe.
/// For one thread; nothing happens but within its calls.
class StreamPublisher {
 public:
  StreamPublisher(Url url, std::string stream, PublisherOptions options = {});

  /// Connects when there is no connection and it is time to try; else reads what the server has to say, for about a
  /// millisecond. Call it at least a few times a second. Errors: missing (no such stream, and none is to be made) and
  /// what the server says against making one; all else is tried again.
  Status look_after();

  [[nodiscard]] bool connected() const { return client_.has_value(); }
  /// Sends the state of the face. `media_time`: ms of a clock of the caller's own that does not fall, more than 0; the
  /// server keeps its spacing. The FAPs must be finite. False when there is no connection: the frame is lost.
  bool publish(const semblante_frame& frame, std::uint64_t media_time);

  /// What happened to the connection since the last call, for people.
  std::optional<std::string> take_news();
  /// Says goodbye.
  void close();

 private:
  using Clock = std::chrono::steady_clock;
  Status connect();
  Status make_stream();
  /// False when the connection is over.
  bool listen(std::chrono::milliseconds patience);
  void lose(const std::string& why);

  Url url_;
  std::string stream_;
  PublisherOptions options_;
  std::optional<StreamClient> client_;
  QuantizerSteps steps_ = standard_quantizers();
  bool has_header_ = false;
  bool needs_keyframe_ = true;
  std::uint64_t sequence_ = 0;
  Clock::time_point next_try_ = Clock::now();
  std::chrono::milliseconds wait_;
  std::optional<std::string> news_;
  std::string last_trouble_;
};

}  // namespace semblante::client

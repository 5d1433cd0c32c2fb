#pragma once

#include <deque>
#include <mutex>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include "protocol/cpp/json_codec.h"
#include "server/streams/stream.h"
#include "server/streams/stream_connection.h"
#include "tests/unit/streams/unframed.h"

namespace semblante::streams {

/// What a stream "s" is made from that sends each batch at once.
inline StreamInfo unbatched_stream() {
  StreamInfo info;
  info.id = "s";
  info.source = "none";
  info.settings.title = "S";
  info.settings.batch_interval = 0;
  info.epoch = 7;
  return info;
}

/// A client's end of a connection without a socket: reads at once, or only when it is told to.
class FakeSocket : public http::WebSocketSink {
 public:
  explicit FakeSocket(http::OutboxLimits limits) : limits_(limits) {}

  http::Sent send(const http::SharedWire& message, http::Purpose purpose) override {
    const std::lock_guard lock(mutex_);
    if (closed_) return http::Sent::closed;
    if (purpose == http::Purpose::state && std::exchange(throws_, false)) throw std::runtime_error("a fault of ours");
    if (reads_) {
      arrive(*message);
      return http::Sent::handed;
    }
    if (waiting_.size() >= (purpose == http::Purpose::state ? limits_.messages : limits_.answers))
      return http::Sent::refused;
    if (waiting_.empty()) since_ = std::chrono::steady_clock::now();
    waiting_.push_back({message, purpose});
    return http::Sent::waits;
  }
  std::size_t drop_state() override {
    const std::lock_guard lock(mutex_);
    return std::erase_if(waiting_, [](const auto& item) { return item.second == http::Purpose::state; });
  }
  [[nodiscard]] bool idle() const override {
    const std::lock_guard lock(mutex_);
    return reads_;
  }
  [[nodiscard]] std::optional<std::chrono::steady_clock::time_point> stalled_since() const override {
    const std::lock_guard lock(mutex_);
    if (reads_) return std::nullopt;
    return since_;
  }
  void close(http::CloseReason reason, const http::SharedWire& last) override {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    if (last && reads_) arrive(*last);
    if (last && !reads_) waiting_.push_back({last, http::Purpose::answer});
    closed_ = std::move(reason);
  }

  // ---- the test's side
  void stop_reading() {
    const std::lock_guard lock(mutex_);
    reads_ = false;
    since_ = std::chrono::steady_clock::now();
  }
  /// The next send of a batch or a state throws, once.
  void throw_once() {
    const std::lock_guard lock(mutex_);
    throws_ = true;
  }
  /// Takes all that waits, as a client would that comes back to its socket.
  void read_again(http::WebSocketPeer& peer) {
    {
      const std::lock_guard lock(mutex_);
      for (const auto& [message, purpose] : waiting_) arrive(*message);
      waiting_.clear();
      reads_ = true;
    }
    peer.writable();
  }
  [[nodiscard]] std::optional<http::CloseReason> closed() const {
    const std::lock_guard lock(mutex_);
    return closed_;
  }
  [[nodiscard]] std::size_t waiting() const {
    const std::lock_guard lock(mutex_);
    return waiting_.size();
  }
  /// What has arrived since the last call, in JSON.
  std::vector<Message> take_all() {
    std::vector<Message> messages;
    for (const auto& payload : take_payloads()) {
      auto message = decode_json(payload);
      EXPECT_TRUE(message) << payload;
      if (message) messages.push_back(*message);
    }
    return messages;
  }
  std::vector<std::string> take_payloads() {
    const std::lock_guard lock(mutex_);
    return std::exchange(arrived_, {});
  }
  /// The wires themselves, to see that they are shared.
  [[nodiscard]] const http::WireMessage* last_wire() const { return last_wire_; }

 private:
  void arrive(const http::WireMessage& message) {
    last_wire_ = &message;
    for (auto& payload : unframed(message.bytes)) arrived_.push_back(std::move(payload));
  }

  const http::OutboxLimits limits_;
  mutable std::mutex mutex_;
  bool reads_ = true;
  bool throws_ = false;
  std::chrono::steady_clock::time_point since_;
  std::deque<std::pair<http::SharedWire, http::Purpose>> waiting_;
  std::vector<std::string> arrived_;
  std::optional<http::CloseReason> closed_;
  const http::WireMessage* last_wire_ = nullptr;
};

/// A connection with such an end, admitted to its stream.
struct FakeClient {
  explicit FakeClient(const std::shared_ptr<Stream>& stream, bool binary = false)
      : connection(std::make_shared<StreamConnection>(stream, binary, false)),
        socket(std::make_shared<FakeSocket>(connection->outbox_limits())) {
    EXPECT_TRUE(stream->admit(connection));
    connection->attach(socket);
  }
  FakeClient(const std::shared_ptr<Stream>& stream, StreamRole role, bool sound = false) : FakeClient(stream) {
    hello(role, sound);
  }
  /// As net does when a socket is gone: a stream and its connections hold each other until then.
  ~FakeClient() { leave(); }
  FakeClient(const FakeClient&) = delete;
  FakeClient& operator=(const FakeClient&) = delete;

  void hello(StreamRole role, bool sound = false) {
    Hello hello;
    hello.role = role;
    hello.sound = sound;
    connection->receive(encode_json(hello), false);
  }
  void leave() {
    if (here) connection->disconnected();
    here = false;
  }
  std::vector<Message> take_all() const { return socket->take_all(); }

  std::shared_ptr<StreamConnection> connection;
  std::shared_ptr<FakeSocket> socket;
  bool here = true;
};

}  // namespace semblante::streams
